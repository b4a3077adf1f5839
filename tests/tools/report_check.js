// The examination of the page of a render. From elsewhere than the page: kPixel, a pixel of the picture with its
// radiance and standard error, and kDark, whether the reader's system is dark.
'use strict';

/** The cells of a table's body below a section, as text. */
const cellsOf = selector => [...document.querySelectorAll(`${selector} tbody tr`)].map(
    row => [...row.cells].map(cell => cell.textContent));

const rowOfPixel =
    name => [1, 2, 3].map(c => readNumber(cellsOf('table.pixel').find(cells => cells[0].startsWith(name))[c]));

/**
 * The values of the pixel under the pointer are those of the file, and on the screen it is as bright as is asked for.
 */
function checkPixelAt(exposure) {
  const {canvas, root, pictures} = viewer;
  root.querySelector('.exposure input').value = exposure;
  viewer.drawNow();
  const place = placeOf(canvas, kPixel, pictures.width, pictures.height);
  const expected = kPixel.radiance.map(x => sRgb(2 ** exposure * x)), colour = colourAt(canvas, place);
  expect(
      expected.every((x, c) => Math.abs(colour[c] - x) <= 2), `colour ${colour} at ${exposure} stops, not ${expected}`);
  canvas.dispatchEvent(new PointerEvent('pointermove', place));
  viewer.drawNow();
  for (const [name, values] of [['radiance', kPixel.radiance], ['standard error, ', kPixel.error]]) {
    const shown = rowOfPixel(name);
    expect(values.every((x, c) => near(shown[c], x, 1e-3)), `${name} ${shown}, not ${values}`);
  }
  const relative = rowOfPixel('standard error /'), ratios = kPixel.error.map((x, c) => 100 * x / kPixel.radiance[c]);
  expect(ratios.every((x, c) => near(relative[c], x, 0.06)), `relative ${relative} %, not ${ratios} %`);
}

function checkExposure() {
  const middle = Number(viewer.root.querySelector('.exposure input').value);
  checkPixelAt(middle);
  checkPixelAt(Math.round(10 * (middle - 1.5)) / 10);
}

/** Each picture is another; errors have a scale instead of an exposure. */
function checkModes() {
  const {root, canvas, pictures} = viewer, inputs = [...root.querySelectorAll('.modes input')];
  expect(inputs.length === encoded.pictures.length, `${inputs.length} pictures, not ${encoded.pictures.length}`);
  const drawn = inputs.map((input, i) => {
    input.click();
    viewer.drawNow();
    const isRadiance = encoded.pictures[i].kind === 'radiance';
    expect(root.querySelector('.exposure').hidden === !isRadiance, `exposure of ${pictures.names[i]}`);
    expect(root.querySelector('.colour-bar').hidden === isRadiance, `colours of ${pictures.names[i]}`);
    return canvas.toDataURL();
  });
  expect(new Set(drawn).size === drawn.length, 'two pictures look the same');
  inputs[0].click();
  viewer.drawNow();
}

/** Arrows move the pixel that is read. */
function checkKeys() {
  const {x, y} = viewer.marked;
  viewer.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight'}));
  viewer.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowUp'}));
  expect(viewer.marked.x === x + 1 && viewer.marked.y === y - 1, 'arrows went elsewhere');
}

/** What techniques find sums to the picture. */
function checkParts() {
  const parts = encoded.pictures.map(({name}, i) => ({name, i}))
                    .filter(({i}) => i > 0 && encoded.pictures[i].kind === 'radiance');
  expect(parts.length > 1, 'there are no parts: this tests nothing');
  const whole = viewer.pictures.of(0), most = Math.max(...whole);
  const far = whole.findIndex(
      (x, at) => Math.abs(parts.reduce((sum, {i}) => sum + viewer.pictures.of(i)[at], 0) - x) > 2e-3 * most);
  expect(far < 0, `parts sum to another picture at ${far}`);
  const rows = cellsOf('#techniques');
  for (const {name, share_of_light: share} of report.techniques)
    expect(
        rows.some(cells => cells[0] === name && near(readNumber(cells[1]), 100 * share, 0.06)), `${name} in ${rows}`);
}

/** Lengths in a bar are as the numbers, of those above 0. */
function checkBar(selector, values) {
  const parts = [...document.querySelectorAll(`${selector} .bar span`)].map(part => part.getBoundingClientRect().width);
  const shown = values.filter(x => x > 0), all = shown.reduce((sum, x) => sum + x, 0);
  const width = parts.reduce((sum, x) => sum + x, 0);
  expect(
      parts.length === shown.length && width > 100 &&
          shown.every((x, i) => Math.abs(parts[i] / width - x / all) < 0.01),
      `${selector}: lengths ${parts} for ${shown}`);
}

/** Stages sum to the time of all. */
function checkTime() {
  const {times} = report, rows = cellsOf('#time');
  const stages = ['importance', 'photon_tracing', 'caustic_tracing', 'map_building', 'eye_pass'].map(key => times[key]);
  const values = [...stages, times.total - stages.reduce((sum, x) => sum + x, 0), times.total];
  values.forEach((x, i) => expect(near(readNumber(rows[i][1]), x, 6e-3), `${rows[i]}, not ${x}`));
  checkBar('#time', values.slice(0, -1));
}

/** What is absorbed, escapes and is cut is what was emitted. */
function checkEnergy() {
  const {energy} = report, rows = cellsOf('#energy');
  const keys = ['absorbed_in_media', 'absorbed_on_surfaces', 'escaped', 'cut_at_max_events'];
  const flows = keys.map(key => energy[key]), found = [0, 1, 2].map(c => flows.reduce((sum, flow) => sum + flow[c], 0));
  [...flows, found, energy.emitted].forEach(
      (flow, i) =>
          flow.forEach((x, c) => expect(near(readNumber(rows[i][1 + c]), x, 1e-3), `${rows[i]}, not ${flow}`)));
  const residual = rows[rows.length - 1];
  expect(residual[0].startsWith('residual'), 'the last row is no residual');
  found.forEach((x, c) => {
    const off = x - energy.emitted[c], shown = readNumber(residual[1 + c]);
    expect(Math.abs(shown - off) <= 1e-3 * Math.abs(off), `residual ${shown}, not ${off}`);
    expect(Math.abs(off) < 0.2 * energy.emitted[c], `residual ${off} of ${energy.emitted}`);
  });
  checkBar('#energy', flows.map(flow => flow[0] + flow[1] + flow[2]));
}

/** Every setting is there, with why it was chosen; Markdown has become text. */
function checkSettings() {
  const rows = cellsOf('#settings');
  expect(rows.length === Object.keys(report.settings).length, `${rows.length} settings`);
  rows.forEach(([key, value, , meaning]) => {
    expect(value === String(report.settings[key]), `${key} is ${value}, not ${report.settings[key]}`);
    const {reason} = report.chosen.find(choice => choice.key === key) ?? {};
    expect(!reason || meaning.includes(`Chosen: ${reason}`), `${key} does not tell its reason`);
    expect(!/`|\]\(/.test(meaning), `Markdown is left: ${meaning}`);
  });
  expect(report.chosen.length > 0, 'nothing was chosen: this tests nothing');
}

const kTexts = ['h2', 'p', 'td', 'caption', '.muted', '.reason', 'code', '.warnings li'];

function check() {
  expect(matchMedia('(prefers-color-scheme: dark)').matches === kDark, `the page is not ${kDark ? 'dark' : 'light'}`);
  expect(
      document.documentElement.scrollWidth <= window.innerWidth,
      `${document.documentElement.scrollWidth} pixels on ${window.innerWidth}`);
  expect(find('title').textContent === 'fog.toml', `the title is ${find('title').textContent}`);
  checkExposure();
  checkKeys();
  checkModes();
  checkParts();
  checkTime();
  checkEnergy();
  checkSettings();
  for (const {command} of data.commands)
    expect([...document.querySelectorAll('pre')].some(pre => pre.textContent === command), `no command ${command}`);
  expect(find('facts').textContent.includes('confidence of 80 %'), 'the error has no interval');
  document.querySelectorAll('details').forEach(details => details.open = true);
  checkContrast('on the screen', [...kTexts, 'summary', 'nav a']);
  layOnPaper();
  checkPaper(kTexts);
}

examine(check);
