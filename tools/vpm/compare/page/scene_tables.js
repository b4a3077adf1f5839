// What the tables of a scene have for columns and rows.
'use strict';

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

const intervalColumn = (title, hint, of) =>
    ({title, hint, key: row => of(row).value, cell: row => intervalCell(of(row))});
const numberColumn = (title, hint, of, text = number) => ({title, hint, key: of, cell: row => text(of(row))});

/** An efficiency over that of the best method. */
function efficiencyColumn(title, hint, of, isBest) {
  const cell = row => (isBest(row) ? element('strong', {}, 'best') : intervalCell(of(row)));
  return {title, hint, key: row => of(row).value, cell};
}

/** A bias in percent, or why it is not determined; null is that of the baseline beside itself. */
function biasCell(row, bias) {
  if (bias === null) return 'baseline';
  if (biasUnknown(row)) return element('span', {title: biasUnknown(row)}, 'not determined');
  return intervalCell(timesHundred(bias));
}

function columnOfBias(title, hint, of) {
  const isKnown = row => of(row) !== null && !biasUnknown(row);
  return {title, hint, key: row => (isKnown(row) ? of(row).value : null), cell: row => biasCell(row, of(row))};
}

const biasColumn = () => columnOfBias('bias, %', results.formulas.bias, row => row.bias);

/** One, where there is a baseline. */
function ownBiasColumns() {
  if (results.baseline === null) return [];
  const hint = `of the mean radiance beside that of ${results.baseline}, whose bias all methods share`;
  return [columnOfBias('own bias, %', hint, row => row.own_bias)];
}

function rowsAt(scene, b) {
  const best = scene.best[b], bestByVariance = scene.best_by_variance[b];
  const marks = index => ({index, isBest: index === best, isBestByVariance: index === bestByVariance});
  return scene.methods.map((method, index) => ({...marks(index), ...method.budgets[b]}));
}

function equalCostTable(scene, b) {
  const f = results.formulas;
  const columns = [
    methodColumn(scene),
    numberColumn('cost', `${budgetCost.title}: mean over repetitions`, costOf),
    intervalColumn('relative MSE', f.relative_mse, row => row.relative_mse),
    efficiencyColumn('efficiency', f.efficiency, row => row.efficiency, row => row.isBest),
    efficiencyColumn(
        'efficiency by variance',
        `${f.efficiency_by_variance}: what sampling alone costs where all methods share a bias, as that of a kernel`,
        row => row.efficiency_by_variance, row => row.isBestByVariance),
    biasColumn(),
    ...ownBiasColumns(),
    intervalColumn('squared bias', f.squared_bias, row => row.squared_bias),
    numberColumn('variance', 'relative MSE less squared bias', row => row.variance),
    intervalColumn('MSE', f.mse, row => row.mse),
    numberColumn(
        'pbrt’s relative MSE', f.relative_mse_of_pbrt + '; mean over repetitions',
        row => meanOf(row, 'relative_mse_of_pbrt')),
  ];
  return sortableTable(`Errors at ${budgetText(b)}, with 95 % intervals`, columns, rowsAt(scene, b), 2);
}

/** Counters that have a column of their own below; others are shown by their name. */
const kRunFields = [
  'cpu_seconds', 'wall_seconds', 'passes', 'photons', 'stored', 'lookups', 'photon_lookups', 'searches',
  'photons_visited', 'photons_used', 'bytes', 'largest_weight', 'effective_sample_size', 'mse', 'relative_mse',
  'relative_mse_of_pbrt', 'mean_ratio', 'variance'
];

function countersTable(scene, b) {
  const per = (row, a, over) => (meanOf(row, over) > 0 ? meanOf(row, a) / meanOf(row, over) : null);
  const positive = x => (x > 0 ? x : null);
  const others = Object.keys(scene.methods[0].budgets[b].runs[0]).filter(key => !kRunFields.includes(key));
  const columns = [
    methodColumn(scene),
    numberColumn('CPU, s', 'mean over repetitions', row => meanOf(row, 'cpu_seconds')),
    numberColumn('wall, s', 'mean over repetitions', row => meanOf(row, 'wall_seconds')),
    numberColumn('passes', 'mean over repetitions', row => meanOf(row, 'passes'), plain),
    numberColumn(
        'look-ups per photon', 'look-ups of density by photons, per photon emitted',
        row => per(row, 'photon_lookups', 'photons')),
    numberColumn(
        'error × look-ups', 'relative MSE times look-ups of density: small where each look-up finds much',
        row => positive(row.relative_mse.value * meanOf(row, 'lookups'))),
    numberColumn('stored per emitted', 'photons in all maps per photon emitted', row => per(row, 'stored', 'photons')),
    numberColumn('searches', 'of photon maps, mean over repetitions', row => meanOf(row, 'searches')),
    numberColumn(
        'visited per search', 'photons whose distance a search computed',
        row => per(row, 'photons_visited', 'searches')),
    numberColumn('used per search', 'photons that count in an estimate', row => per(row, 'photons_used', 'searches')),
    numberColumn('MiB', 'photon maps and guides of the largest pass', row => meanOf(row, 'bytes') / 2 ** 20),
    numberColumn(
        'largest weight', 'of a photon, in any repetition',
        row => Math.max(...row.runs.map(run => run.largest_weight))),
    {
      title: 'effective sample size',
      hint: 'of collisions, the least of the repetitions',
      key: sampleSize,
      cell: row => number(sampleSize(row))
    },
    ...others.map(key => numberColumn(key.replaceAll('_', ' '), 'mean over repetitions', row => meanOf(row, key))),
  ];
  return sortableTable(`Counters at ${budgetText(b)}`, columns, rowsAt(scene, b));
}

/** The cost of reaching an error, and over the least: known, or a bound where the budgets do not span it. */
function costOfError(method, target, cost, least) {
  if (cost !== null) return {key: cost, text: `${number(cost)} (${number(cost / least, 2)}\u202f×)`};
  if (method.budgets[0].relative_mse.value < target) return {key: 0, text: `< ${number(costOf(method.budgets[0]))}`};
  if (last(method.budgets).relative_mse.value > target)
    return {key: Infinity, text: `> ${number(costOf(last(method.budgets)))}`};
  return {key: null, text: 'not determined'};
}

function equalErrorTable(scene) {
  const {methods, targets} = scene;
  const least = targets.map((_, t) => Math.min(...methods.map(method => method.equal_error[t] ?? Infinity)));
  const cost = (row, t) => costOfError(methods[row.index], targets[t], methods[row.index].equal_error[t], least[t]);
  const columnOf = (target, t) => {
    const hint = `that of ${methods[scene.best[t]].name}, best at ${budgetText(t)}`;
    return {
      title: `relative MSE ${number(target)}`,
      hint,
      key: row => cost(row, t).key,
      cell: row => cost(row, t).text
    };
  };
  const caption = `Cost (${budgetCost.title}) at which a relative MSE is reached, and how many times the least`;
  const rows = methods.map((_, index) => ({index}));
  return sortableTable(caption, [methodColumn(scene), ...targets.map(columnOf)], rows, targets.length);
}

function pairsTable(scene) {
  const columns = [
    methodColumn(scene, betterOf, 'more efficient'),
    methodColumn(scene, worseOf, 'less efficient'),
    intervalColumn('ratio', `${results.formulas.efficiency}; ${results.formulas.intervals}`, ratioOf),
    numberColumn('p', results.formulas.p, pair => pair.p, p => number(p, 2)),
    numberColumn('p (Holm)', results.formulas.p, pair => pair.p_holm, p => number(p, 2)),
    {
      title: 'difference',
      words: true,
      key: difference,
      cell: pair => (isSignificant(pair) ? element('strong', {}, difference(pair)) : difference(pair))
    },
  ];
  return sortableTable(`Efficiencies at ${budgetText(results.budgets.length - 1)}, all pairs`, columns, scene.pairs, 4);
}

function difference(pair) {
  if (pair.p_holm === null) return 'not determined';
  return isSignificant(pair) ? 'significant' : 'none shown';
}

function pairsText(scene) {
  const significant = scene.pairs.filter(isSignificant).length,
        unknown = scene.pairs.filter(pair => pair.p_holm === null).length;
  return `${significant} of ${scene.pairs.length} pairs differ significantly (p by Holm below ${kFamilyWise})` +
      (unknown > 0 ? `; not determined: ${unknown}, for the reference is too noisy.` : '.');
}

function aboutTable(caption, entries) {
  const said = (flag, yes, no) => (flag === undefined ? kNothing : flag ? yes : no);
  const word = (title, of) => ({title, words: true, key: of, cell: of});
  const columns = [
    word('name', s => s.name), word('what it is', s => s.summary), word('how it fails', s => s.failure),
    word('source, in papers/references.bib', s => s.source)
  ];
  const fact = (flag, title, yes, no) => {
    if (entries.some(s => s[flag] !== undefined)) columns.push(word(title, s => said(s[flag], yes, no)));
  };
  fact('unbiased', 'bias', 'none', 'biased');
  fact('bounded_weight', 'weights', 'bounded', 'without bound');
  fact('heterogeneous', 'grids', 'yes', 'refused');
  return sortableTable(caption, columns, entries);
}
