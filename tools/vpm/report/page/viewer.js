// The picture, its errors and its parts, one at a time.
'use strict';

const kErrorText = {
  error: 'root mean square over channels of the standard error / √(R² + 0.01 mean(R)²), R being the radiance',
  bias: 'mean over channels of the bias / √(R² + 0.01 mean(R)²), R being the radiance',
};

class Viewer extends PictureView {
  constructor(root, pictures, block, rendered) {
    super(root, pictures);
    this.block = block;        // pixels of the film along an edge of one that is shown
    this.rendered = rendered;  // those of the film that are shown
    this.fillModes(pictures.names, 'shown');
    this.find('.modes').hidden = pictures.length === 1;
    this.markParts();
    this.reset();
    this.find('.modes').addEventListener('input', () => this.resetScale());
    this.listen();
  }

  get shown() { return Number(this.find('.modes input:checked').value); }
  get kind() { return this.pictures.encoded[this.shown].kind; }

  /** Says that pictures of radiance other than the first are parts of that. */
  markParts() {
    const first = this.pictures.encoded.findIndex(({kind}, i) => i > 0 && kind === 'radiance');
    if (first > 0)
      this.find('.modes').children[1 + first].before(element('span', {class: 'muted'}, 'of the radiance, found by'));
  }

  reset() {
    this.view = wholeView(this.pictures);
    this.resetExposure();
    this.resetScale();
  }

  /** Errors that pixels have are well below the end of the scale. */
  resetScale() {
    if (this.kind === 'radiance') return;
    const typical = relativeSize(this.pictures.of(this.shown), this.pictures.of(0));
    this.find('.range input').value = Math.log10(5 * typical || 1);
  }

  panes(width, height) {
    const {kind, exposure, fullScale, shown} = this, whole = {left: 0, top: 0, width, height};
    const layer = kind === 'radiance' ? {kind, exposure} : {kind, against: 0, full: fullScale};
    return [{pane: whole, clip: whole, painting: this.painting(shown, layer), label: this.pictures.names[shown]}];
  }

  showControls() {
    const {kind, fullScale} = this, bar = this.find('.colour-bar');
    this.showScales(kind === 'radiance');
    this.canvas.setAttribute('aria-label', this.pictures.names[this.shown]);
    bar.hidden = kind === 'radiance';
    if (!bar.hidden) showColourBar(bar, kind === 'bias', fullScale, kErrorText[kind]);
  }

  /** By its place in the film. */
  nameOf({x, y}) {
    const {x0, y0, x1, y1} = this.rendered, {block} = this;
    if (block === 1) return super.nameOf({x: x0 + x, y: y0 + y});
    const ends = (at, begin, end) => `${begin + at * block} to ${Math.min(end, begin + (at + 1) * block) - 1}`;
    return `Mean of the pixels (${ends(x, x0, x1)}, ${ends(y, y0, y1)})`;
  }

  /** Radiance, errors, and the part that is looked at. */
  showPixel() {
    const {pictures, marked, shown} = this, radiance = this.valuesOf(0);
    const rows = pictures.encoded.flatMap(({kind}, i) => {
      if (i !== 0 && i !== shown && kind === 'radiance') return [];
      const values = this.valuesOf(i), name = `${pictures.names[i]}, W/(m² sr)`;
      const row = [name, ...values.map(x => number(x, 4))];
      if (kind !== 'error') return [row];
      const relative =
          values.map((x, c) => (marked && radiance[c] !== 0 ? percent(x / Math.abs(radiance[c])) : kNothing));
      return [row, ['standard error / radiance', ...relative]];
    });
    this.fillPixelTable(rows, 'Point at a pixel to see its radiance');
  }

  valuesOf(i) { return this.marked ? [...this.pictures.pixel(i, this.marked)] : [null, null, null]; }
}

/** The root of the mean square of errors over what they are errors of, as relativeTo(); without those not finite. */
function relativeSize(errors, others) {
  const means = channelMeans(others), d = [0, 0, 0], off = i => errors[i];
  let sum = 0, count = 0;
  for (let at = 0; at < errors.length; at += 3) {
    relativeTo(others, means, off, at, d);
    const size = rootMeanSquare(d);
    if (Number.isFinite(size)) [sum, count] = [sum + size * size, count + 1];
  }
  return count > 0 ? Math.sqrt(sum / count) : 0;
}

/** What the pictures in the page are of those in the file. */
function aboutPictures({width, height, block, pictures}, report) {
  const megabytes = pictures.reduce((sum, {halves}) => sum + halves.length, 0) / 1e6;
  const size = `The pictures take ${number(megabytes, 2)} MB of this page, as half floats (11 bits).`;
  if (block === 1) return `${size} Each pixel is one of the file.`;
  const {x0, y0, x1, y1} = report.rendered_pixels;
  return `${size} The file has ${x1 - x0} × ${y1 - y0} pixels; here are ${width} × ${height}, each the mean of ` +
      `${block} × ${block} of these. Standard errors and bias are those of single pixels of the file, over which the ` +
      'root mean square and the mean are taken.';
}
