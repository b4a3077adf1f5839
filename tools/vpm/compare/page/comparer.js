// The image comparer of a scene: two pictures in one of several modes, and thumbnails of all that follow its view.
'use strict';

const kModes = [
  {kind: 'radiance', layout: 'one', name: 'flip'},
  {kind: 'radiance', layout: 'two', name: 'side by side'},
  {kind: 'radiance', layout: 'divided', name: 'slider'},
  {kind: 'relative', layout: 'one', name: 'relative error of A against B'},
  {kind: 'signed', layout: 'one', name: 'signed difference A − B'},
];

class Comparer extends PictureView {
  constructor(root, scene, pictures, index) {
    super(root, pictures);
    this.scene = scene;
    this.flipped = false;  // whether B is on top
    this.typicalError = typicalError(scene);
    this.fillControls(index);
    this.fillThumbnails();
    this.find('.swap').addEventListener('click', () => this.change(() => this.swap()));
    this.find('.flip').addEventListener('click', () => this.change(() => this.flip()));
    this.listen();
  }

  get mode() { return kModes[this.find('.modes input:checked').value]; }
  get first() { return Number(this.find('.first-picture').value); }
  get second() { return Number(this.find('.second-picture').value); }
  get across() { return this.mode.layout === 'two' ? 2 : 1; }
  get split() { return Number(this.find('.split input').value); }

  fillControls(index) {
    fillSelect(this.find('.first-picture'), this.pictures.names, 1);
    fillSelect(this.find('.second-picture'), this.pictures.names, 0);
    this.fillModes(kModes.map(({name}) => name), `mode-${index}`);
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

  flip() { this.flipped = !this.flipped; }

  swap() {
    const [a, b] = [this.find('.first-picture'), this.find('.second-picture')];
    [a.value, b.value] = [b.value, a.value];
  }

  reset() {
    this.view = wholeView(this.pictures);
    this.resetExposure();
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

  /** A picture as the mode shows it. */
  painting(picture) {
    const {mode: {kind}, second, exposure, fullScale} = this;
    return super.painting(picture, kind === 'radiance' ? {kind, exposure} : {kind, against: second, full: fullScale});
  }

  drawNow() {
    const context = super.drawNow(), {mode, split, canvas} = this;
    if (!context) return;
    if (mode.layout === 'divided') drawDivision(context, split * canvas.clientWidth, canvas.clientHeight);
    this.followWithThumbnails();
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
    const {mode, fullScale, first, second, pictures} = this;
    this.showScales(mode.kind === 'radiance');
    this.find('.split').hidden = mode.layout !== 'divided';
    this.find('.flip').hidden = mode.name !== 'flip';
    this.canvas.setAttribute(
        'aria-label', `${mode.name}: A is ${pictures.names[first]}, B is ${pictures.names[second]}`);
    const bar = this.find('.colour-bar'), isSigned = mode.kind === 'signed';
    bar.hidden = mode.kind === 'radiance';
    showColourBar(
        bar, isSigned, fullScale,
        `${isSigned ? 'mean' : 'root mean square'} over channels of (A − B) / √(B² + 0.01 mean(B)²)`);
  }

  /** The values of the marked pixel in A and B. */
  showPixel() {
    const {pictures, marked, first, second} = this;
    const values = picture => (marked ? [...pictures.pixel(picture, marked)] : [null, null, null]);
    const a = values(first), b = values(second);
    this.fillPixelTable(
        [
          ['A', ...a.map(x => number(x, 4))], ['B', ...b.map(x => number(x, 4))],
          ['A / B − 1', ...a.map((x, c) => (marked && b[c] !== 0 ? percent(x / b[c] - 1) : kNothing))]
        ],
        'Point at a pixel to see its radiance');
  }

  /** Dragging moves the pictures; near the division of the slider, that. */
  dragged(from) {
    const width = this.canvas.clientWidth;
    if (this.mode.layout !== 'divided' || Math.abs(from.x - this.split * width) >= 12) return super.dragged(from);
    return dx => {
      this.find('.split input').value = (from.x + dx) / width;
    };
  }

  keys(far) { return {...super.keys(far), ' ': () => this.flip()}; }
}

/** A relative error that pixels have: the root of the median over methods of what they have at last. */
function typicalError(scene) {
  const errors =
      scene.methods.map(method => last(method.budgets).relative_mse.value).filter(x => x > 0).sort((a, b) => a - b);
  return errors.length > 0 ? Math.sqrt(errors[Math.floor(errors.length / 2)]) : 1;
}

function drawDivision(context, x, height) {
  for (const [colour, width] of [['black', 3], ['white', 1]]) {
    context.fillStyle = colour;
    context.fillRect(x - width / 2, 0, width, height);
  }
}
