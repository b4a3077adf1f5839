// How pages are examined: numbers and colours as a reader sees them.
'use strict';

const expect = (holds, text) => {
  if (!holds) fail(text);
};
const near = (a, b, relative) => Math.abs(a - b) <= relative * Math.abs(b);

/** The number that a text begins with, as the page writes numbers. */
function readNumber(text) {
  const digits = {'⁻': '-', '⁰': 0, '¹': 1, '²': 2, '³': 3, '⁴': 4, '⁵': 5, '⁶': 6, '⁷': 7, '⁸': 8, '⁹': 9};
  const [, mantissa, exponent = ''] =
      text.match(/^(−?[\d.]+)[^×]*(?:×\u202f10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?/) ?? [null, 'NaN'];
  return Number(mantissa.replace('−', '-')) * 10 ** Number([...exponent].map(c => digits[c]).join(''));
}

/** Where a pixel of the pictures is on the screen while all of them is shown. */
function placeOf(canvas, {x, y}, width, height) {
  const box = canvas.getBoundingClientRect(), scale = Math.min(box.width / width, box.height / height);
  return {
    clientX: box.left + box.width / 2 + (x + 0.5 - width / 2) * scale,
    clientY: box.top + box.height / 2 + (y + 0.5 - height / 2) * scale
  };
}

/** The colour in a canvas at a place of the screen. */
function colourAt(canvas, {clientX, clientY}) {
  const box = canvas.getBoundingClientRect(), density = canvas.width / box.width;
  return [...canvas.getContext('2d')
              .getImageData(Math.round((clientX - box.left) * density), Math.round((clientY - box.top) * density), 1, 1)
              .data];
}

/** The sRGB curve [IEC1999], to 0 ... 255. */
const sRgb = x => 255 * Math.min(1, x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

/** Leaves the verdict where the test finds it. */
function examine(check) {
  try {
    check();
  } catch (error) {
    fail(`exception: ${error.message}`);
  }
  document.body.dataset.verdict = failures.length === 0 ? 'passed' : failures.join(' | ');
}
