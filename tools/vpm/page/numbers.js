// Numbers as people read them: as many digits as are known, intervals in brackets.
'use strict';

const kNothing = '–';

/** floor(log10 |x|), 0 of 0. */
const exponentOf = x => (x === 0 ? 0 : Math.floor(Math.log10(Math.abs(x)) + 1e-12));

const superscript = n => String(n).replace(/[-\d]/g, c => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]));
const tenTo = exponent => (exponent === 0 ? '' : `\u202f×\u202f10${superscript(exponent)}`);

/** Whether numbers of that exponent are written with a power of ten. */
const isFar = exponent => exponent < -2 || exponent > 5;

/** With that many decimals; rounded to tens, hundreds ... where there are less than none. */
function fixed(x, decimals) {
  if (decimals < 0) return fixed(Math.round(x * 10 ** decimals) / 10 ** decimals, 0);
  const text = Math.abs(x).toFixed(Math.min(20, decimals));
  return x < 0 && Number(text) !== 0 ? '−' + text : text;
}

/** To that many significant digits; a dash for null. */
function number(x, digits = 3) {
  if (x === null || x === undefined || Number.isNaN(x)) return kNothing;
  if (x === 0) return '0';
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '−∞';
  const exponent = exponentOf(Number(x.toPrecision(digits)));
  if (isFar(exponent)) return fixed(x / 10 ** exponent, digits - 1) + tenTo(exponent);
  return fixed(x, digits - 1 - exponent);
}

/** A count, or a number as somebody chose it: all its digits. */
const plain = x => (Math.abs(x) < 1e6 ? String(Number(x.toPrecision(6))) : number(x));

/** A value with its interval, all to two digits of half the interval's length, with a common power of ten. */
function interval({value, lo, hi}) {
  if (value === null) return 'not determined';
  if (lo === null || hi === null) return `${number(value)} [not determined]`;
  const largest = Math.max(Math.abs(value), Math.abs(lo), Math.abs(hi));
  const exponent = isFar(exponentOf(largest)) ? exponentOf(largest) : 0;
  const half = (hi - lo) / 2 || largest / 500;
  const decimals = Math.min(1 - exponentOf(half), 4 - exponentOf(largest)) + exponent;
  const [v, l, h] = [value, lo, hi].map(x => fixed(x / 10 ** exponent, decimals));
  return `${v} [${l}, ${h}]${tenTo(exponent)}`;
}

const percent = x => `${number(100 * x, 2)}\u202f%`;
const timesHundred = ({value, lo, hi}) => ({value: times(value, 100), lo: times(lo, 100), hi: times(hi, 100)});
const times = (x, factor) => (x === null ? null : x * factor);
