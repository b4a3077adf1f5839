// The image comparer of a scene: two pictures in one of several modes, and thumbnails of all that follow its view.
'use strict';

const kModes = [
  {kind: 'radiance', layout: 'one', name: 'flip'},
  {kind: 'radiance', layout: 'two', name: 'side by side'},
  {kind: 'radiance', layout: 'divided', name: 'slider'},
  {kind: 'relative', layout: 'one', name: 'relative error of A against B'},
  {kind: 'signed', layout: 'one', name: 'signed difference A − B'},
];

class Comparer {
  constructor(root, scene, pictures, index) {
    Object.assign(this, {root, scene, pictures});
    this.find = selector => root.querySelector(selector);
    this.canvas = this.find('canvas.view');
    this.view = wholeView(pictures);
    this.marked = null;    // the pixel whose values are shown
    this.flipped = false;  // whether B is on top
    this.paintings = new Map();
    this.automatic = autoExposure(pictures.of(0));
    this.typicalError = typicalError(scene);
    this.fillControls(index);
    this.fillThumbnails();
    this.listen();
    this.draw();
    new ResizeObserver(() => this.draw()).observe(root);
  }

  get mode() { return kModes[this.find('.modes input:checked').value]; }
  get first() { return Number(this.find('.first-picture').value); }
  get second() { return Number(this.find('.second-picture').value); }
  get exposure() { return Number(this.find('.exposure input').value); }
  get fullScale() { return 10 ** Number(this.find('.range input').value); }
  get split() { return Number(this.find('.split input').value); }

  fillControls(index) {
    fillSelect(this.find('.first-picture'), this.pictures.names, 1);
    fillSelect(this.find('.second-picture'), this.pictures.names, 0);
    kModes.forEach((mode, i) => {
      const input = element('input', {type: 'radio', name: `mode-${index}`, value: i});
      input.checked = i === 0;
      this.find('.modes').append(element('label', {}, input, mode.name));
    });
    const exposure = this.find('.exposure input'), middle = Math.round(10 * this.automatic) / 10;
    Object.assign(exposure, {min: middle - 10, max: middle + 10});
    this.reset();
  }

  /** A small picture of each, by groups, with what the tables say of it. */
  fillThumbnails() {
    this.thumbnails = [];
    for (const {title, members} of this.pictures.groups) {
      const buttons = members.map(i => this.thumbnail(i));
      this.find('.thumbnails').append(element('h4', {}, title), element('div', {}, ...buttons));
    }
  }

  thumbnail(i) {
    const name = this.pictures.names[i], canvas = this.thumbnails[i] = element('canvas');
    const button = element(
        'button', {type: 'button', title: `Put into A: ${name}`}, canvas, element('span', {}, name),
        element('span', {class: 'muted'}, this.pictures.remarks[i]));
    button.addEventListener('click', () => this.change(() => {
      this.find('.first-picture').value = i;
    }));
    return button;
  }

  listen() {
    const redraw = () => this.draw();
    for (const control of this.root.querySelectorAll('select, input')) control.addEventListener('input', redraw);
    this.find('.swap').addEventListener('click', () => this.change(() => this.swap()));
    this.find('.flip').addEventListener('click', () => this.change(() => {
      this.flipped = !this.flipped;
    }));
    this.find('.reset').addEventListener('click', () => this.change(() => this.reset()));
    this.canvas.addEventListener('pointerdown', event => this.startDrag(event));
    this.canvas.addEventListener('pointermove', event => this.point(event));
    this.canvas.addEventListener('keydown', event => this.press(event));
    this.canvas.addEventListener('wheel', event => this.turn(event), {passive: false});
  }

  change(action) {
    action();
    this.draw();
  }

  swap() {
    const [a, b] = [this.find('.first-picture'), this.find('.second-picture')];
    [a.value, b.value] = [b.value, a.value];
  }

  reset() {
    this.view = wholeView(this.pictures);
    this.find('.exposure input').value = Math.round(10 * this.automatic) / 10;
    this.find('.split input').value = 0.5;
    this.find('.range input').value = Math.log10(4 * this.typicalError);
  }

  /** The parts of the canvas, each with what is painted on it. */
  panes(width, height) {
    const {mode, first, second, split} = this, names = this.pictures.names;
    const whole = {left: 0, top: 0, width, height};
    const part = (pane, clip, picture, letter, labelRight = false) =>
        ({pane, clip, painting: this.painting(picture), label: `${letter}: ${names[picture]}`, labelRight});
    if (mode.layout === 'two') {
      const half = {...whole, width: width / 2 - 2}, other = {...half, left: width / 2 + 2};
      return [part(half, half, first, 'A'), part(other, other, second, 'B')];
    }
    if (mode.layout === 'divided') {
      const left = {...whole, width: width * split},
            right = {...whole, left: width * split, width: width * (1 - split)};
      return [part(whole, left, first, 'A'), part(whole, right, second, 'B', true)];
    }
    if (mode.kind === 'radiance')
      return [this.flipped ? part(whole, whole, second, 'B') : part(whole, whole, first, 'A')];
    return [{...part(whole, whole, first, 'A'), label: `A: ${names[first]}, B: ${names[second]}`}];
  }

  /** A picture as the mode shows it. Paintings are kept until something about all of them changes. */
  painting(picture) {
    const {mode: {kind}, second, exposure, fullScale} = this;
    const layer = kind === 'radiance' ? {kind, exposure} : {kind, against: second, full: fullScale};
    const common = JSON.stringify(layer);
    if (common !== this.painted) this.paintings.clear();
    this.painted = common;
    if (!this.paintings.has(picture)) this.paintings.set(picture, painted(this.pictures, {...layer, picture}));
    return this.paintings.get(picture);
  }

  /** Draws everything once before the next frame. */
  draw() {
    this.frame ??= requestAnimationFrame(() => {
      this.frame = undefined;
      this.drawNow();
    });
  }

  drawNow() {
    const {pictures, view, marked, mode, canvas} = this;
    const width = canvas.clientWidth, across = mode.layout === 'two' ? 2 : 1;
    if (width === 0) return;
    const height = Math.round(
        Math.min(width / across * pictures.height / pictures.width, Math.max(320, 0.7 * window.innerHeight)));
    const context = sizedContext(canvas, width, height);
    this.parts = this.panes(width, height);
    for (const part of this.parts) drawPane(context, part, pictures, view, marked);
    if (mode.layout === 'divided') drawDivision(context, this.split * width, height);
    this.followWithThumbnails();
    this.showControls();
    this.showPixel();
  }

  /** At once where they only move; where all must be painted anew, when the reader's hand rests. */
  followWithThumbnails() {
    clearTimeout(this.rest);
    if (this.paintings.size === this.pictures.length)
      this.drawThumbnails();
    else
      this.rest = setTimeout(() => this.drawThumbnails(), 100);
  }

  drawThumbnails() {
    const {pictures, view, marked} = this;
    this.thumbnails.forEach((canvas, i) => {
      const width = canvas.clientWidth, height = Math.round(width * pictures.height / pictures.width);
      const pane = {left: 0, top: 0, width, height};
      drawPane(
          sizedContext(canvas, width, height), {pane, clip: pane, painting: this.painting(i)}, pictures, view, marked);
      canvas.parentElement.classList.toggle('chosen', i === this.first);
    });
  }

  showControls() {
    const {mode, exposure, fullScale, first, second, pictures} = this;
    this.find('.exposure').hidden = mode.kind !== 'radiance';
    this.find('.range').hidden = mode.kind === 'radiance';
    this.find('.split').hidden = mode.layout !== 'divided';
    this.find('.flip').hidden = mode.name !== 'flip';
    this.find('.exposure output').textContent = `${exposure < 0 ? '−' : '+'}${Math.abs(exposure).toFixed(1)} stops`;
    this.find('.range output').textContent = percent(fullScale);
    this.canvas.setAttribute(
        'aria-label', `${mode.name}: A is ${pictures.names[first]}, B is ${pictures.names[second]}`);
    showColourBar(this.find('.colour-bar'), mode.kind, fullScale);
  }

  /** The values of the marked pixel in A and B. */
  showPixel() {
    const {pictures, marked, first, second} = this;
    const table = this.find('table.pixel');
    table.caption.textContent = marked ? `Pixel (${marked.x}, ${marked.y}), counted from the upper left corner` :
                                         'Point at a pixel to see its radiance';
    table.tBodies[0].replaceChildren(pixelRow(['', 'red', 'green', 'blue'], 'th'));
    table.classList.toggle('empty', !marked);
    const values = picture => (marked ? [...pictures.pixel(picture, marked)] : [null, null, null]);
    const a = values(first), b = values(second);
    table.tBodies[0].append(
        pixelRow(['A', ...a.map(x => number(x, 4))]), pixelRow(['B', ...b.map(x => number(x, 4))]),
        pixelRow(['A / B − 1', ...a.map((x, c) => (marked && b[c] !== 0 ? percent(x / b[c] - 1) : kNothing))]));
  }

  /** The part of the canvas under the pointer, and the point of the pictures there. */
  under(event) {
    const {left, top} = this.canvas.getBoundingClientRect(), x = event.clientX - left, y = event.clientY - top;
    const part = this.parts.find(({clip}) => x >= clip.left && x < clip.left + clip.width) ?? this.parts[0];
    return {x, y, pane: part.pane, point: picturePoint(part.pane, this.pictures, this.view, x, y)};
  }

  point(event) {
    if (!this.parts || this.drag) return;
    const pixel = pixelAt(this.pictures, this.under(event).point);
    if (pixel)
      this.change(() => {
        this.marked = pixel;
      });
  }

  /** Dragging moves the pictures; near the division of the slider, that. */
  startDrag(event) {
    const from = this.under(event), view = this.view, width = this.canvas.clientWidth;
    const moves = this.mode.layout === 'divided' && Math.abs(from.x - this.split * width) < 12;
    const scale = magnification(from.pane, this.pictures, view);
    const drag = moved => this.change(() => {
      const dx = moved.clientX - event.clientX, dy = moved.clientY - event.clientY;
      if (moves)
        this.find('.split input').value = (from.x + dx) / width;
      else
        this.view = bounded({...view, x: view.x - dx / scale, y: view.y - dy / scale}, this.pictures);
    });
    const end = () => {
      this.drag = false;
      this.canvas.removeEventListener('pointermove', drag);
    };
    this.drag = true;
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.addEventListener('pointermove', drag);
    for (const ending of ['pointerup', 'pointercancel']) this.canvas.addEventListener(ending, end, {once: true});
  }

  turn(event) {
    if (document.activeElement !== this.canvas && !event.ctrlKey) return;  // the page scrolls
    event.preventDefault();
    const {point} = this.under(event);
    this.change(() => {
      this.view = zoomed(this.view, 2 ** (-event.deltaY / 300), point, this.pictures);
    });
  }

  press(event) {
    const far = event.shiftKey ? 10 : 1;
    const middle = this.marked ? {x: this.marked.x + 0.5, y: this.marked.y + 0.5} : this.view;
    const zoom = factor => {
      this.view = zoomed(this.view, factor, middle, this.pictures);
    };
    const actions = {
      ArrowLeft: () => this.moveMark(-far, 0),
      ArrowRight: () => this.moveMark(far, 0),
      ArrowUp: () => this.moveMark(0, -far),
      ArrowDown: () => this.moveMark(0, far),
      '+': () => zoom(Math.SQRT2),
      '=': () => zoom(Math.SQRT2),
      '-': () => zoom(Math.SQRT1_2),
      '0': () => {
        this.view = wholeView(this.pictures);
      },
      ' ': () => {
        this.flipped = !this.flipped;
      },
    };
    if (!actions[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    this.change(actions[event.key]);
  }

  /** Moves the marked pixel; the view follows where it is zoomed. */
  moveMark(dx, dy) {
    const {pictures, view} = this;
    const from = this.marked ?? {x: Math.floor(view.x), y: Math.floor(view.y)};
    const within = (x, size) => Math.min(size - 1, Math.max(0, x));
    this.marked = {x: within(from.x + dx, pictures.width), y: within(from.y + dy, pictures.height)};
    this.view = bounded({...view, x: this.marked.x + 0.5, y: this.marked.y + 0.5}, pictures);
  }
}

/** A relative error that pixels have: the root of the median over methods of what they have at last. */
function typicalError(scene) {
  const errors =
      scene.methods.map(method => last(method.budgets).relative_mse.value).filter(x => x > 0).sort((a, b) => a - b);
  return errors.length > 0 ? Math.sqrt(errors[Math.floor(errors.length / 2)]) : 1;
}

const pixelRow = (cells, tag = 'td') =>
    element('tr', {}, ...cells.map((text, i) => element(i === 0 ? 'th' : tag, {}, text)));

function drawDivision(context, x, height) {
  for (const [colour, width] of [['black', 3], ['white', 1]]) {
    context.fillStyle = colour;
    context.fillRect(x - width / 2, 0, width, height);
  }
}

/** What the colours of an error mode mean. */
function showColourBar(bar, kind, full) {
  bar.hidden = kind === 'radiance';
  if (bar.hidden) return;
  const steps = Array.from({length: 33}, (_, i) => i / 32);
  const colours = steps.map(t => (kind === 'relative' ? heat(t) : signed(2 * t - 1)));
  bar.querySelector('div').style.background =
      `linear-gradient(to right, ${colours.map(c => `rgb(${c.join(' ')})`).join(', ')})`;
  const ends = kind === 'relative' ? [full / 100, full / 10, full] : [-full, 0, full];
  bar.querySelector('p').textContent = kind === 'relative' ?
      'root mean square over channels of (A − B) / √(B² + 0.01 mean(B)²)' :
      'mean over channels of (A − B) / √(B² + 0.01 mean(B)²)';
  bar.querySelector('ol').replaceChildren(...ends.map(x => element('li', {}, percent(x))));
}
