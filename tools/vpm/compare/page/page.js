// The page put together: each scene's plot, tables and pictures, and the texts behind them.
'use strict';

const find = id => document.getElementById(id);

function provenance() {
  const {machine} = results;
  return [
    ['vpm', results.vpm],
    ['Machine', `${machine.processor}, ${machine.cores} cores, ${machine.threads} threads used; ${machine.system}`],
    ['Repetitions', `${results.repetitions}, seeds ${results.seed} to ${results.seed + results.repetitions - 1}`],
    ['Budgets', `${results.budgets.map(plain).join(', ')} ${results.unit}`],
    ['Methods', String(results.scenes[0].methods.length)],
  ];
}

/** The best method at the last budget, and what it is better than. */
function finding(scene) {
  const best = last(scene.best), others = scene.methods.map((_, i) => i).filter(i => i !== best);
  const efficiency = i => last(scene.methods[i].budgets).efficiency;
  const next = others.reduce((a, b) => ((efficiency(b).value ?? 0) > (efficiency(a).value ?? 0) ? b : a));
  const beaten = scene.pairs.filter(pair => isSignificant(pair) && betterOf(pair) === best).length;
  const ofNext = efficiency(next).value === null ? '' : `The next, ${scene.methods[next].name}, is ${interval(efficiency(next))} times as efficient. `;
  return `At ${budgetText(results.budgets.length - 1)}, ${scene.methods[best].name} has the smallest relative MSE × cost. ${ofNext}` +
    `Significantly less efficient: ${beaten} of the ${others.length} others (5 % family-wise over all pairs).`;
}

const isSignificant = pair => pair.p_holm !== null && pair.p_holm < kFamilyWise;
const betterOf = pair => (pair.value >= 1 ? pair.first : pair.second);
const worseOf = pair => (pair.value >= 1 ? pair.second : pair.first);

/** The ratio of a pair's efficiencies, the better one's over the other's. */
function ratioOf({value, lo, hi}) {
  const over = x => (x === null ? null : 1 / x);
  return value >= 1 || value === null ? {value, lo, hi} : {value: 1 / value, lo: over(hi), hi: over(lo)};
}

/** The first column: methods by their number in `row`. */
const methodColumn = (scene, of = row => row.index, title = 'method') =>
  ({title, words: true, key: row => scene.methods[of(row)].name, cell: row => methodLabel(scene, of(row))});

const intervalColumn = (title, hint, of) => ({title, hint, key: row => of(row).value, cell: row => intervalCell(of(row))});
const numberColumn = (title, hint, of, text = number) => ({title, hint, key: of, cell: row => text(of(row))});

const rowsAt = (scene, b) => scene.methods.map((method, index) => ({index, ...method.budgets[b], isBest: scene.best[b] === index}));

function equalCostTable(scene, b) {
  const f = results.formulas;
  const columns = [
    methodColumn(scene),
    numberColumn('cost', `${budgetCost.title}: mean over repetitions`, costOf),
    intervalColumn('relative MSE', f.relative_mse, row => row.relative_mse),
    {title: 'efficiency', hint: f.efficiency, key: row => row.efficiency.value,
     cell: row => (row.isBest ? element('strong', {}, 'best') : intervalCell(row.efficiency))},
    {title: 'bias, %', hint: f.bias, key: row => (biasUnknown(row) ? null : row.bias.value),
     cell: row => (biasUnknown(row) ? element('span', {title: biasUnknown(row)}, 'not determined') : intervalCell(timesHundred(row.bias)))},
    intervalColumn('squared bias', f.squared_bias, row => row.squared_bias),
    numberColumn('variance', 'relative MSE less squared bias', row => row.variance),
    intervalColumn('MSE', f.mse, row => row.mse),
  ];
  return sortableTable(`Errors at ${budgetText(b)}, with 95 % intervals`, columns, rowsAt(scene, b), 2);
}

/** Counters that have a column of their own below; others are shown by their name. */
const kRunFields = ['cpu_seconds', 'wall_seconds', 'passes', 'photons', 'stored', 'lookups', 'bytes', 'largest_weight',
                    'effective_sample_size', 'mse', 'relative_mse', 'mean_ratio'];

function countersTable(scene, b) {
  const per = (row, a, over) => (meanOf(row, over) > 0 ? meanOf(row, a) / meanOf(row, over) : null);
  const others = Object.keys(scene.methods[0].budgets[b].runs[0]).filter(key => !kRunFields.includes(key));
  const columns = [
    methodColumn(scene),
    numberColumn('CPU, s', 'mean over repetitions', row => meanOf(row, 'cpu_seconds')),
    numberColumn('wall, s', 'mean over repetitions', row => meanOf(row, 'wall_seconds')),
    numberColumn('passes', 'mean over repetitions', row => meanOf(row, 'passes'), plain),
    numberColumn('look-ups per photon', 'look-ups of density, by photons and eye paths, per photon emitted',
                 row => per(row, 'lookups', 'photons')),
    numberColumn('error × look-ups', 'relative MSE times look-ups of density: small where each look-up tells much',
                 row => (row.relative_mse.value > 0 && meanOf(row, 'lookups') > 0 ? row.relative_mse.value * meanOf(row, 'lookups') : null)),
    numberColumn('stored per emitted', 'photons in all maps per photon emitted', row => per(row, 'stored', 'photons')),
    numberColumn('MiB', 'photon maps and guides of the largest pass', row => meanOf(row, 'bytes') / 2 ** 20),
    numberColumn('largest weight', 'of a photon, in any repetition', row => Math.max(...row.runs.map(run => run.largest_weight))),
    {title: 'effective sample size', hint: `of collisions, the least of the repetitions; below ${kLeastSampleSize} nothing is determined`, key: sampleSize,
     cell: row => (biasUnknown(row) ? `not determined (${number(sampleSize(row))})` : number(sampleSize(row)))},
    ...others.map(key => numberColumn(key.replaceAll('_', ' '), 'mean over repetitions', row => meanOf(row, key))),
  ];
  return sortableTable(`Counters at ${budgetText(b)}`, columns, rowsAt(scene, b));
}

/** The cost of reaching an error, and over the least: known, or a bound where the budgets do not span it. */
function costOfError(method, target, cost, least) {
  if (cost !== null) return {key: cost, text: `${number(cost)} (${number(cost / least, 2)}\u202f×)`};
  if (method.budgets[0].relative_mse.value < target) return {key: 0, text: `< ${number(costOf(method.budgets[0]))}`};
  if (last(method.budgets).relative_mse.value > target) return {key: Infinity, text: `> ${number(costOf(last(method.budgets)))}`};
  return {key: null, text: 'not determined'};
}

function equalErrorTable(scene) {
  const least = scene.targets.map((_, t) => Math.min(...scene.methods.map(method => method.equal_error[t] ?? Infinity)));
  const rows = scene.methods.map((method, index) => ({
    index, costs: method.equal_error.map((cost, t) => costOfError(method, scene.targets[t], cost, least[t])),
  }));
  const columns = scene.targets.map((target, t) => ({
    title: `relative MSE ${number(target)}`, hint: `that of ${scene.methods[scene.best[t]].name}, best at ${budgetText(t)}`,
    key: row => row.costs[t].key, cell: row => row.costs[t].text,
  }));
  return sortableTable(`Cost (${budgetCost.title}) at which a relative MSE is reached, and how many times the least`, [methodColumn(scene), ...columns], rows,
                       scene.targets.length);
}

function pairsTable(scene) {
  const columns = [
    methodColumn(scene, betterOf, 'more efficient'), methodColumn(scene, worseOf, 'less efficient'),
    intervalColumn('ratio', `${results.formulas.efficiency}; ${results.formulas.intervals}`, ratioOf),
    numberColumn('p', results.formulas.p, pair => pair.p, p => number(p, 2)),
    numberColumn('p, Holm', results.formulas.p, pair => pair.p_holm, p => number(p, 2)),
    {title: 'difference', words: true, key: verdict, cell: pair => (isSignificant(pair) ? element('strong', {}, verdict(pair)) : verdict(pair))},
  ];
  return sortableTable(`Efficiencies at ${budgetText(results.budgets.length - 1)}, all pairs`, columns, scene.pairs, 4);
}

const verdict = pair => (pair.p_holm === null ? 'not determined' : isSignificant(pair) ? 'significant' : 'none shown');

function pairsText(scene) {
  const significant = scene.pairs.filter(isSignificant).length, unknown = scene.pairs.filter(pair => pair.p_holm === null).length;
  return `${significant} of ${scene.pairs.length} pairs differ significantly (p by Holm below ${kFamilyWise})` +
    (unknown > 0 ? `; not determined: ${unknown}, for the reference is too noisy.` : '.');
}

/** The scene's pictures with their names, and what the tables say of each. */
function namedPictures(scene, encoded) {
  const budget = method => last(method.budgets), budgets = budgetText(results.budgets.length - 1);
  const names = ['reference', ...scene.methods.map(m => m.name), ...scene.methods.map(m => `${m.name}, mean of ${results.repetitions}`)];
  const pictures = new Pictures(encoded, names);
  pictures.remarks = [
    scene.reference.relative_mse > 0 ? `relative MSE ${number(scene.reference.relative_mse)}` : 'taken to be exact',
    ...scene.methods.map(m => `relative MSE ${number(budget(m).runs[0].relative_mse)}`),
    ...scene.methods.map(m => `squared bias ${interval(budget(m).squared_bias)}`),
  ];
  const numbers = names.map((_, i) => i), runs = 1 + scene.methods.length;
  pictures.groups = [
    {title: `The reference, and the first run of each method at ${budgets}`, members: numbers.slice(0, runs)},
    {title: `Means of ${results.repetitions} repetitions: the more of these, the more of what is left is bias`, members: numbers.slice(runs)},
  ];
  return pictures;
}

const plots = [];

function buildScene(scene, index, encoded) {
  const root = find('scene-template').content.cloneNode(true).querySelector('section');
  const part = selector => root.querySelector(selector);
  root.id = `scene-${index}`;
  find('scenes').append(root);
  part('h2').textContent = scene.name;
  part('.reference-text').textContent = `Reference: ${scene.reference.source}. ${scene.width} × ${scene.height} pixels. Scene file: ${scene.file}`;
  part('.finding').textContent = finding(scene);
  plots.push(new ErrorPlot(root, scene));
  const intervalPlots = kIntervalPlots.map(kind => new IntervalPlot(part('.interval-plots'), scene, kind));
  plots.push(...intervalPlots);
  const budget = part('.budget'), atBudget = () => {
    intervalPlots.forEach(plot => plot.show(rowsAt(scene, Number(budget.value))));
    part('.equal-cost').replaceChildren(equalCostTable(scene, Number(budget.value)));
    part('.counters').replaceChildren(countersTable(scene, Number(budget.value)));
  };
  fillSelect(budget, results.budgets.map((_, b) => budgetText(b)), results.budgets.length - 1);
  budget.addEventListener('change', atBudget);
  atBudget();
  part('.equal-error').append(equalErrorTable(scene));
  part('.pairs-text').textContent = pairsText(scene);
  part('.pairs').append(pairsTable(scene));
  return new Comparer(part('.comparer'), scene, namedPictures(scene, encoded), index);
}

function aboutTable(caption, entries) {
  const said = (flag, yes, no) => (flag === undefined ? kNothing : flag ? yes : no);
  const word = (title, of) => ({title, words: true, key: of, cell: of});
  const columns = [word('name', s => s.name), word('what it is, and how it fails', s => s.summary)];
  if (entries.some(s => s.unbiased !== undefined)) {
    columns.push(word('bias', s => said(s.unbiased, 'none', 'biased')), word('weights', s => said(s.bounded_weight, 'bounded', 'without bound')),
                 word('grids', s => said(s.heterogeneous, 'yes', 'refused')));
  }
  return sortableTable(caption, columns, entries);
}

/** The overrides of a method, and all settings they lead to on each scene. */
function methodTexts() {
  return results.scenes[0].methods.map((method, m) => {
    const scenes = results.scenes.map(scene =>
      `${scene.name} (scene hash ${scene.methods[m].scene_hash})\n${scene.methods[m].settings.split(' ').map(s => `  ${s}`).join('\n')}`);
    const overrides = method.overrides.length > 0 ? method.overrides.join('\n') : 'the scene as it is';
    return foldedText(method.name, `${overrides}\n\nWith this, the settings are:\n\n${scenes.join('\n\n')}`);
  });
}

function fileTexts() {
  const scenes = results.scenes.map(scene => {
    const overrides = scene.overrides.length > 0 ? `# with ${scene.overrides.join(', ')}\n` : '';
    return foldedText(`${scene.name}: ${scene.file}`, overrides + scene.text);
  });
  return [foldedText('The experiment', results.experiment), ...scenes];
}

function fillContents() {
  const links = results.scenes.map((scene, i) => [`scene-${i}`, scene.name]);
  links.push(['methods', 'Methods'], ['strategies', 'Strategies'], ['formulas', 'Formulas'], ['texts', 'Files']);
  find('contents').append(...links.map(([id, name]) => element('li', {}, element('a', {href: `#${id}`}, name))));
}

function saveResults() {
  const url = URL.createObjectURL(new Blob([JSON.stringify(results, null, 1)], {type: 'application/json'}));
  element('a', {href: url, download: 'results.json'}).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Plots and swatches in the colours that hold now. */
function recolour() {
  plots.forEach(plot => plot.draw());
  document.querySelectorAll('canvas.swatch').forEach(canvas => drawSwatch(canvas, Number(canvas.dataset.series)));
}

function withLightColours(action) {
  document.documentElement.classList.add('light');
  action();
  document.documentElement.classList.remove('light');
}

function followColours() {
  const root = document.documentElement.classList;
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', recolour);
  window.addEventListener('beforeprint', () => { root.add('light'); recolour(); });
  window.addEventListener('afterprint', () => { root.remove('light'); recolour(); });
}

document.title = find('title').textContent = results.title;
fillFacts(find('provenance'), provenance());
fillContents();
const encodedPictures = read('pictures');
const comparers = results.scenes.map((scene, i) => buildScene(scene, i, encodedPictures[i]));
find('method-texts').append(...methodTexts());
find('distance-strategies').append(aboutTable('Distance strategies', about.distance));
find('transmittance-estimators').append(aboutTable('Transmittance estimators', about.transmittance));
fillFacts(find('formula-list'), Object.entries(results.formulas).map(([name, text]) => [name.replaceAll('_', ' '), text]));
find('file-texts').append(...fileTexts());
find('save-results').addEventListener('click', saveResults);
followColours();
