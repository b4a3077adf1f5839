// A canvas that shows pictures and is used by pointer, wheel and keyboard: what is seen of them, and which pixel is
// read.
'use strict';

/** What derives from it says what is painted where, and shows the controls and the marked pixel. */
class PictureView {
  constructor(root, pictures) {
    Object.assign(this, {root, pictures});
    this.find = selector => root.querySelector(selector);
    this.canvas = this.find('canvas.view');
    this.view = wholeView(pictures);
    this.marked = null;  // the pixel whose values are shown
    this.paintings = new Map();
    this.automatic = autoExposure(pictures.of(0));
  }

  get exposure() { return Number(this.find('.exposure input').value); }
  get fullScale() { return 10 ** Number(this.find('.range input').value); }
  get across() { return 1; }  // panes beside each other

  /** A radio button for each name, of which the first is chosen. */
  fillModes(names, group) {
    names.forEach((name, i) => {
      const input = element('input', {type: 'radio', name: group, value: i});
      input.checked = i === 0;
      this.find('.modes').append(element('label', {}, input, name));
    });
  }

  /** Ten stops to either side of the automatic exposure. */
  resetExposure() {
    const middle = Math.round(10 * this.automatic) / 10;
    Object.assign(this.find('.exposure input'), {min: middle - 10, max: middle + 10, value: middle});
  }

  listen() {
    const redraw = () => this.draw();
    for (const control of this.root.querySelectorAll('select, input')) control.addEventListener('input', redraw);
    this.find('.reset').addEventListener('click', () => this.change(() => this.reset()));
    this.canvas.addEventListener('pointerdown', event => this.startDrag(event));
    this.canvas.addEventListener('pointermove', event => this.point(event));
    this.canvas.addEventListener('keydown', event => this.press(event));
    this.canvas.addEventListener('wheel', event => this.turn(event), {passive: false});
    new ResizeObserver(redraw).observe(this.root);
    this.draw();
  }

  change(action) {
    action();
    this.draw();
  }

  /**
   * A picture as a layer shows it, without the picture's number. Paintings are kept until something about all of them
   * changes.
   */
  painting(picture, layer) {
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
    const {pictures, view, marked, canvas} = this, width = canvas.clientWidth;
    if (width === 0) return;
    const height = Math.round(
        Math.min(width / this.across * pictures.height / pictures.width, Math.max(320, 0.7 * window.innerHeight)));
    const context = sizedContext(canvas, width, height);
    this.parts = this.panes(width, height);
    for (const part of this.parts) drawPane(context, part, pictures, view, marked);
    this.showControls();
    this.showPixel();
    return context;
  }

  /** What sliders of exposure and of the scale of errors stand at. */
  showScales(isRadiance) {
    const {exposure, fullScale} = this;
    this.find('.exposure').hidden = !isRadiance;
    this.find('.range').hidden = isRadiance;
    this.find('.exposure output').textContent = `${exposure < 0 ? '−' : '+'}${Math.abs(exposure).toFixed(1)} stops`;
    this.find('.range output').textContent = percent(fullScale);
  }

  nameOf({x, y}) { return `Pixel (${x}, ${y})`; }

  /** A table of the marked pixel: rows of a name and three values, as text. `pointAt`: what to point at to see. */
  fillPixelTable(rows, pointAt) {
    const {marked} = this, table = this.find('table.pixel');
    table.caption.textContent = marked ? `${this.nameOf(marked)}, counted from the upper left corner` : pointAt;
    table.classList.toggle('empty', !marked);
    table.tBodies[0].replaceChildren(
        pixelRow(['', 'red', 'green', 'blue'], 'th'), ...rows.map(cells => pixelRow(cells)));
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

  /** What dragging from a place does, given how far it went. */
  dragged(from) {
    const {view} = this, scale = magnification(from.pane, this.pictures, view);
    return (dx, dy) => {
      this.view = bounded({...view, x: view.x - dx / scale, y: view.y - dy / scale}, this.pictures);
    };
  }

  startDrag(event) {
    const move = this.dragged(this.under(event));
    const drag = moved => this.change(() => move(moved.clientX - event.clientX, moved.clientY - event.clientY));
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

  /** What keys do. */
  keys(far) {
    const middle = this.marked ? {x: this.marked.x + 0.5, y: this.marked.y + 0.5} : this.view;
    const zoom = factor => {
      this.view = zoomed(this.view, factor, middle, this.pictures);
    };
    return {
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
    };
  }

  press(event) {
    const action = this.keys(event.shiftKey ? 10 : 1)[event.key];
    if (!action || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    this.change(action);
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

const pixelRow = (cells, tag = 'td') =>
    element('tr', {}, ...cells.map((text, i) => element(i === 0 ? 'th' : tag, {}, text)));

/** What the colours of errors mean: of heat(), two decades up to `full`, or of signed(). */
function showColourBar(bar, isSigned, full, text) {
  const steps = Array.from({length: 33}, (_, i) => i / 32);
  const colours = steps.map(t => (isSigned ? signed(2 * t - 1) : heat(t)));
  bar.querySelector('div').style.background =
      `linear-gradient(to right, ${colours.map(c => `rgb(${c.join(' ')})`).join(', ')})`;
  const ends = isSigned ? [-full, 0, full] : [full / 100, full / 10, full];
  bar.querySelector('p').textContent = text;
  bar.querySelector('ol').replaceChildren(...ends.map(x => element('li', {}, percent(x))));
}
