// Pictures: from bytes to radiance, and from radiance to colours on the screen.
'use strict';

/** The value of each pattern of a 16-bit floating-point number [IEEE2019, sec. 3.4, binary16]. */
const kHalves = Float64Array.from({length: 65536}, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24);
});

/** Red, green and blue of all pixels, rows from the top, W/(m^2 sr). */
function decoded({exponent, halves}) {
  const bytes = atob(halves), scale = 2 ** exponent;
  const values = new Float64Array(bytes.length / 2);
  for (let i = 0; i < values.length; ++i) {
    values[i] = scale * kHalves[bytes.charCodeAt(2 * i) | (bytes.charCodeAt(2 * i + 1) << 8)];
  }
  return values;
}

/** Pictures of one size, decoded when they are first looked at. */
class Pictures {
  constructor({width, height, pictures}, names) {
    Object.assign(this, {width, height, encoded: pictures, names});
    this.values = [];
  }
  get length() { return this.encoded.length; }
  of(i) { return (this.values[i] ??= decoded(this.encoded[i])); }
  pixel(i, {x, y}) {
    const at = 3 * (y * this.width + x);
    return this.of(i).subarray(at, at + 3);
  }
}

const channelMeans = values => [0, 1, 2].map(c => {
  let sum = 0;
  for (let i = c; i < values.length; i += 3) sum += values[i];
  return 3 * sum / values.length;
});

/**
 * What is `off` at a pixel's channels, over sqrt(B^2 + 0.01 mean(B)^2) of another picture: of differences A - B the
 * mean square is the relative MSE.
 */
function relativeTo(others, means, off, at, d) {
  for (let c = 0; c < 3; ++c) {
    const x = off(at + c);
    d[c] = x === 0 ? 0 : x / Math.sqrt(others[at + c] ** 2 + 0.01 * means[c] ** 2);
  }
}

const rootMeanSquare = d => Math.sqrt((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / 3);

/** Relative MSE of a picture against another; the noise of both counts. */
function relativeError(values, others) {
  const means = channelMeans(others), d = [0, 0, 0], off = i => values[i] - others[i];
  let sum = 0;
  for (let at = 0; at < values.length; at += 3) {
    relativeTo(others, means, off, at, d);
    sum += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }
  return sum / values.length;
}

/** The exposure, in stops, that takes the 99th percentile of the luminance of lit pixels to 0.8. */
function autoExposure(values) {
  const lit = [];
  for (let i = 0; i < values.length; i += 3) {
    const luminance = 0.2126 * values[i] + 0.7152 * values[i + 1] + 0.0722 * values[i + 2];
    if (Number.isFinite(luminance) && luminance > 0) lit.push(luminance);
  }
  lit.sort((a, b) => a - b);
  return lit.length > 0 ? Math.log2(0.8 / lit[Math.floor(0.99 * (lit.length - 1))]) : 0;
}

/** The sRGB curve [IEC1999], from linear values to 0 ... 255. */
const toScreen = x => 255 * (x <= 0.0031308 ? 12.92 * Math.max(0, x) : 1.055 * Math.min(1, x) ** (1 / 2.4) - 0.055);

const kMagenta = [255, 0, 255];  // what is not finite

/**
 * From dark to bright by way of hues, as bright on grey paper: the cubehelix [Green2011, eq. 2] of start 0.5 and -1.5
 * turns.
 */
function heat(t) {
  const angle = 2 * Math.PI * (0.5 / 3 + 1 - 1.5 * t), depth = t * (1 - t) / 2;
  const [cos, sin] = [depth * Math.cos(angle), depth * Math.sin(angle)];
  return [t - 0.14861 * cos + 1.78277 * sin, t - 0.29227 * cos - 0.90649 * sin, t + 1.97294 * cos].map(
      x => 255 * Math.min(1, Math.max(0, x)));
}

const kBelow = [0, 90, 181], kEqual = [247, 247, 247], kAbove = [200, 70, 0];

/** From blue (-1) by way of white to orange (1). */
function signed(t) {
  const end = t < 0 ? kBelow : kAbove, share = Math.min(1, Math.abs(t));
  return kEqual.map((x, c) => x + (end[c] - x) * share);
}

const kHeatDecades = 2;

/** Where a relative error stands on the scale of heat(): logarithmic, two decades below `full`. */
const heatPlace = (error, full) => Math.min(1, Math.max(0, 1 + Math.log10(error / full) / kHeatDecades));

/** Colours of a pixel, by the kind of layer. `at` is the place of its red. */
const kPainters = {
  radiance: (pictures, {picture, exposure}) => {
    const values = pictures.of(picture), gain = 2 ** exposure;
    return (at, colour) => {
      for (let c = 0; c < 3; ++c) colour[c] = toScreen(gain * values[at + c]);
      return Number.isFinite(values[at] + values[at + 1] + values[at + 2]);
    };
  },
  relative: (pictures, layer) => errorPainter(pictures, layer, differenceOf(pictures, layer), heatOf(layer)),
  signed: (pictures, layer) => errorPainter(pictures, layer, differenceOf(pictures, layer), signOf(layer)),
  // Pictures that are errors of `against` themselves.
  error: (pictures, layer) => errorPainter(pictures, layer, valueOf(pictures, layer), heatOf(layer)),
  bias: (pictures, layer) => errorPainter(pictures, layer, valueOf(pictures, layer), signOf(layer)),
};

const heatOf = ({full}) => d => heat(heatPlace(rootMeanSquare(d), full));
const signOf = ({full}) => d => signed((d[0] + d[1] + d[2]) / 3 / full);

function differenceOf(pictures, {picture, against}) {
  const values = pictures.of(picture), others = pictures.of(against);
  return i => values[i] - others[i];
}

function valueOf(pictures, {picture}) {
  const values = pictures.of(picture);
  return i => values[i];
}

function errorPainter(pictures, {against}, off, colourOf) {
  const others = pictures.of(against), means = channelMeans(others), d = [0, 0, 0];
  return (at, colour) => {
    relativeTo(others, means, off, at, d);
    const known = Number.isFinite(d[0] + d[1] + d[2]);
    if (known) [colour[0], colour[1], colour[2]] = colourOf(d);
    return known;
  };
}

/** A canvas of the pictures' size with a layer painted on it, a pixel each. */
function painted(pictures, layer) {
  const {width, height} = pictures;
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d'), image = context.createImageData(width, height);
  const paint = kPainters[layer.kind](pictures, layer), colour = [0, 0, 0], {data} = image;
  for (let i = 0; i < width * height; ++i) {
    const shown = paint(3 * i, colour) ? colour : kMagenta;
    for (let c = 0; c < 3; ++c) data[4 * i + c] = shown[c];
    data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  return canvas;
}
