// The page's examination: it is used as a reader would use it, and what it shows is compared with the data. The verdict
// is left in an attribute. From elsewhere than the page: kPixel, a pixel of the reference with its value, and kDark,
// whether the reader's system is dark.
'use strict';

/** Whether a number is the value of an interval, in two digits of half the interval's length. */
const isValueOf = (shown, {value, lo, hi}) => Math.abs(shown - value) <= 0.05 * (hi - lo) / 2;

/** Points of a canvas that have a colour, "#rrggbb". */
function inkOf(canvas, colour) {
  const wanted = [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let ink = 0;
  for (let i = 0; i < data.length; i += 4)
    ink += wanted.every((value, c) => Math.abs(data[i + c] - value) < 3) && data[i + 3] > 250;
  return ink;
}

/** Errors and costs of all kinds are drawn. A bias may be too uncertain for a line. */
function checkPlot(root, scene) {
  const [metric, cost] = ['.metric', '.cost'].map(selector => root.querySelector(selector));
  const plot = root.querySelector('.plot canvas'), colours = scene.methods.map((_, i) => cssColour(`--series-${i}`));
  for (const select of [metric, cost]) {
    for (const option of select.options) {
      select.value = option.value;
      select.dispatchEvent(new Event('change'));
      expect(
          metric.value > 1 || colours.some(colour => inkOf(plot, colour) > 50),
          `nothing in the plot of ${option.text}`);
    }
    select.selectedIndex = 0;
    select.dispatchEvent(new Event('change'));
  }
}

/** In the legend each method has its slope, and a click on all others leaves its line alone. */
function checkLegend(root, scene) {
  const plot = root.querySelector('.plot canvas'), buttons = [...root.querySelectorAll('.legend button')];
  scene.methods.forEach((method, i) => {
    const text = buttons[i].textContent, others = buttons.filter(button => button !== buttons[i]);
    expect(
        text.includes(method.name) && isValueOf(readNumber(text.split('slope ')[1]), method.slope), `legend: ${text}`);
    others.forEach(button => button.click());
    scene.methods.forEach(
        (_, k) =>
            expect(inkOf(plot, cssColour(`--series-${k}`)) > 50 === (k === i), `${method.name} alone: colour ${k}`));
    others.forEach(button => button.click());
  });
}

/** On logarithmic axes every power of ten has a label, and there are two labels at least; methods have whole names. */
function checkAxes(root, scene) {
  for (const canvas of root.querySelectorAll('.plot canvas, .interval-plots canvas'))
    for (const scale of Object.values(Chart.getChart(canvas).scales).filter(({type}) => type === 'logarithmic')) {
      const powers =
          scale.ticks.filter(({value}) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6);
      expect(powers.every(tick => tick.label), `a decade of '${scale.options.title.text}' has no label`);
      expect(
          scale.ticks.filter(tick => tick.label).length > 1,
          `'${scale.options.title.text}' from ${scale.min} to ${scale.max} has no two labels`);
    }
  for (const canvas of root.querySelectorAll('.interval-plots canvas')) {
    const names = Chart.getChart(canvas).scales.y.ticks.map(({label}) => label.join(' '));
    expect(names.join('|') === scene.methods.map(({name}) => name).join('|'), `methods ${names}`);
  }
}

/** Long axes have labels between decades, dense ones none; no name is cut. */
function checkLabels() {
  const digits = (min, max, length) => labelledDigits({min, max}, length, 20).join('');
  expect(digits(1e-4, 1e-2, 300) === '125' && digits(1e-8, 1, 300) === '1', 'digits of labels');
  expect(digits(0.3, 0.9, 300) === '123456789' && digits(2.1, 6, 20) === '123456789', 'digits of short axes');
  for (const name of ['photons, single scattering by shadow rays', 'a'.repeat(50)])
    expect(linesOf(name).join('').replaceAll(' ', '') === name.replaceAll(' ', ''), `${name} is cut`);
}

/** Tables that are wider than their place have shadows that scroll, and covers that do not. */
function checkScrolling(root) {
  for (const box of root.querySelectorAll('.scroll'))
    expect(getComputedStyle(box).backgroundAttachment === 'local, local, scroll, scroll', 'a table shows no shadows');
}

const columnOf = (table, index) => [...table.tBodies[0].rows].map(row => row.cells[index].textContent);

/** A click sorts up, another one down. */
function checkSorting(table) {
  [...table.tHead.rows[0].cells].forEach((head, index) => {
    for (const direction of ['ascending', 'descending']) {
      const before = head.getAttribute('aria-sort');
      if (before !== direction) head.querySelector('button').click();
      expect(head.getAttribute('aria-sort') === direction, `${head.textContent} is not ${direction}`);
      const keys = columnOf(table, index).map(readNumber).filter(x => !Number.isNaN(x));
      const sign = direction === 'ascending' ? 1 : -1;
      const numeric = head.className === 'number' && !columnOf(table, index).some(text => /best|[<>]/.test(text));
      expect(
          !numeric || keys.every((key, i) => i === 0 || sign * key >= sign * keys[i - 1]),
          `${head.textContent} is not sorted: ${keys}`);
    }
  });
}

/** The table at equal cost has the numbers of each budget, in the order of the errors. */
function checkEqualCost(root, scene) {
  const select = root.querySelector('.budget');
  results.budgets.forEach((_, b) => {
    select.value = b;
    select.dispatchEvent(new Event('change'));
    const errors = scene.methods.map(method => method.budgets[b].relative_mse).sort((x, y) => x.value - y.value);
    const shown = columnOf(root.querySelector('.equal-cost table'), 2).map(readNumber);
    expect(
        errors.length === shown.length && errors.every((error, i) => isValueOf(shown[i], error)),
        `errors ${shown}, not ${errors.map(error => error.value)}`);
    const best = root.querySelector('.equal-cost td:nth-child(5) strong').closest('tr').cells[0].textContent;
    expect(scene.best_by_variance[b] !== scene.best[b], 'one method is the best by all: this tests nothing');
    expect(best === scene.methods[scene.best_by_variance[b]].name, `${best} is not the best by variance`);
  });
}

/** The verdicts are those of the data, at the last budget; those who are biased are marked and counted. */
function checkVerdicts(root, scene) {
  const rows = [...root.querySelectorAll('.verdicts tbody tr')];
  expect(rows.length === scene.methods.length, `${rows.length} verdicts`);
  for (const {cells} of rows) {
    const {verdict, budgets} = scene.methods.find(method => method.name === cells[0].textContent);
    const isBiased = verdict.says === 'biased', own = last(budgets).own_bias;
    expect(cells[1].textContent.startsWith(verdict.says), `${cells[1].textContent}, not ${verdict.says}`);
    expect(!own || isValueOf(readNumber(cells[2].textContent), timesHundred(own)), `own bias ${cells[2].textContent}`);
    expect(isBiased === (cells[1].querySelector('strong.biased') !== null), `${verdict.says} is marked otherwise`);
    expect(
        verdict.p_holm === null || near(readNumber(cells[4].textContent), verdict.p_holm, 0.06),
        `p ${cells[4].textContent}, not ${verdict.p_holm}`);
  }
  const biased = scene.methods.filter(method => method.verdict.says === 'biased').length;
  expect(readNumber(root.querySelector('.verdicts-text').textContent) === biased, `not ${biased} biased`);
}

/** The picture of the first run has the error that vpm gave it, so it is that picture. */
function checkErrors(comparer, scene) {
  scene.methods.forEach((method, i) => {
    const run = last(method.budgets).runs[0],
          error = relativeError(comparer.pictures.of(1 + i), comparer.pictures.of(0));
    expect(
        near(error, run.relative_mse + scene.reference.relative_mse, 2e-3),
        `${method.name}: error ${error}, not ${run.relative_mse}`);
  });
}

/** What a method's techniques find are pictures in a group of its own, which sum to its first run. */
function checkParts({root, pictures}, method, m) {
  const title = `What each technique of ${method.name} finds`, begins = text => text.startsWith(title);
  const group = pictures.groups.find(group => begins(group.title)), keeps = method.techniques.length > 0;
  const heading = [...root.querySelectorAll('.thumbnails h4')].find(head => begins(head.textContent));
  expect(
      (group !== undefined) === keeps && (heading !== undefined) === keeps, `${title}: ${keeps ? 'missing' : 'shown'}`);
  if (!group) return;
  const names = group.members.map(i => pictures.names[i]);
  expect(names.join() === method.techniques.map(({name}) => `${method.name}, ${name}`).join(), `${title}: ${names}`);
  expect(heading.nextElementSibling.children.length === names.length, `${title}: not ${names.length} thumbnails`);
  const sums = pictures.of(1 + m).map((_, at) => group.members.reduce((sum, i) => sum + pictures.of(i)[at], 0));
  expect(sums.every((sum, at) => near(sum, pictures.of(1 + m)[at], 3e-3)), `${title}: pictures that sum to another`);
}

/** The table has the numbers of each technique, whose shares sum to 1. */
function checkTechniques(root, scene, comparer) {
  const rows = [...root.querySelectorAll('.techniques tbody tr')];
  scene.methods.forEach((method, m) => {
    checkParts(comparer, method, m);
    const own = rows.filter(({cells}) => cells[0].textContent === method.name);
    expect(own.length === method.techniques.length, `${own.length} techniques of ${method.name}`);
    for (const {name, share_of_light, found_alone, variance} of method.techniques) {
      const numbers = own.filter(({cells}) => cells[1].textContent === name)
                          .flatMap(({cells}) => [2, 3, 4].map(i => readNumber(cells[i].textContent)));
      const expected = [100 * share_of_light, 100 * found_alone, variance];
      expect(expected.every((x, i) => near(numbers[i], x, 0.006)), `${name}: ${numbers}, not ${expected}`);
    }
    const shares = own.reduce((sum, {cells}) => sum + readNumber(cells[2].textContent), 0);
    expect(own.length === 0 || near(shares, 100, 0.01), `shares of ${method.name} sum to ${shares} %`);
  });
  expect(rows.length > 0, 'no method has techniques: this tests nothing');
}

/** Under the pointer is the pixel's value, and what is on the screen is that, exposed; zooming keeps it where it is. */
function checkPixel(comparer, scene) {
  const {root, canvas} = comparer, point = () => canvas.dispatchEvent(new PointerEvent('pointermove', place));
  root.querySelector('.first-picture').value = 0;
  comparer.drawNow();
  const place = placeOf(canvas, kPixel, scene.width, scene.height);
  point();
  const exposure = Number(root.querySelector('.exposure input').value);
  const expected = kPixel.value.map(x => sRgb(2 ** exposure * x));
  comparer.drawNow();
  const rowOfB = root.querySelector('table.pixel').tBodies[0].rows[2];
  const shown = [1, 2, 3].map(c => readNumber(rowOfB.cells[c].textContent));
  expect(kPixel.value.every((x, c) => near(shown[c], x, 1e-3)), `pixel ${shown}, not ${kPixel.value}`);
  expect(
      colourAt(canvas, place).slice(0, 3).every((x, c) => Math.abs(x - expected[c]) <= 2),
      `colour ${colourAt(canvas, place)}, not ${expected}`);
  for (const key of ['+', '+', '+']) canvas.dispatchEvent(new KeyboardEvent('keydown', {key}));
  comparer.drawNow();
  point();
  expect(comparer.marked.x === kPixel.x && comparer.marked.y === kPixel.y, 'zooming moved the pixel');
  canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight'}));
  expect(comparer.marked.x === kPixel.x + 1 && comparer.marked.y === kPixel.y, 'an arrow went elsewhere');
}

/** Every way to compare two pictures draws something. */
function checkModes(comparer) {
  comparer.root.querySelector('.first-picture').value = 1;
  const drawn = [...comparer.root.querySelectorAll('.modes input')].map(input => {
    input.click();
    comparer.drawNow();
    return comparer.canvas.toDataURL();
  });
  expect(new Set(drawn).size === drawn.length, 'two modes show the same');
}

const kTexts = ['h2', 'p', 'td', 'td .brackets', 'th .method', 'caption', '.muted', '.biased', 'summary'];

/** As printing does it: first an event, then the rules for paper, then a new drawing. */
function print() {
  window.dispatchEvent(new Event('beforeprint'));
  expect(cssColour('--ground') === '#ffffff', 'what is drawn before printing is not drawn for white paper');
  layOnPaper();
  recolour();
}

function check() {
  expect(matchMedia('(prefers-color-scheme: dark)').matches === kDark, `the page is not ${kDark ? 'dark' : 'light'}`);
  expect(
      document.title === results.title && find('title').textContent === results.title,
      'the title is not the experiment\'s');
  expect(
      document.documentElement.scrollWidth <= window.innerWidth,
      `${document.documentElement.scrollWidth} pixels on ${window.innerWidth}`);
  checkLabels();
  results.scenes.forEach((scene, i) => {
    const root = find(`scene-${i}`);
    checkPlot(root, scene);
    checkLegend(root, scene);
    checkAxes(root, scene);
    checkScrolling(root);
    checkEqualCost(root, scene);
    checkVerdicts(root, scene);
    root.querySelectorAll('table.sortable').forEach(checkSorting);
    checkErrors(comparers[i], scene);
    checkTechniques(root, scene, comparers[i]);
    checkPixel(comparers[i], scene);
    checkModes(comparers[i]);
  });
  expect(find('file-texts').textContent.includes(results.scenes[0].text), 'the scene\'s text is not in the page');
  document.querySelectorAll('details').forEach(details => details.open = true);
  checkContrast('on the screen', [...kTexts, 'nav a']);
  print();
  checkPaper(kTexts);
}

examine(check);
