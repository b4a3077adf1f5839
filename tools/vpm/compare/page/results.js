// What the page is about: the results that vpm wrote, and how their numbers are called.
'use strict';

const kFamilyWise = 0.05;  // rate of pairs wrongly called different

const results = read('results');
const about = read('about');

/** What cost can be: keys of a run. Names are those of the experiment's units. */
const kCosts = [
  {key: 'cpu_seconds', name: 's of CPU time', title: 'CPU time, s'},
  {key: 'wall_seconds', name: 's', title: 'wall time, s'},
  {key: 'passes', name: 'passes', title: 'passes'},
  {key: 'photons', name: 'photons emitted', title: 'photons emitted'},
  {key: 'lookups', name: 'look-ups of density', title: 'look-ups of density'},
];
const budgetCost = kCosts.find(cost => cost.name === results.unit);

/** Of a value that is known up to its sign. */
function magnitude({value, lo, hi}) {
  const known = value !== null && lo !== null && hi !== null;
  if (!known) return {value: value === null ? null : Math.abs(value), lo: null, hi: null};
  const ends = [Math.abs(lo), Math.abs(hi)];
  return {value: Math.abs(value), lo: lo < 0 && hi > 0 ? 0 : Math.min(...ends), hi: Math.max(...ends)};
}

const last = array => array[array.length - 1];
const mean = numbers => numbers.reduce((sum, x) => sum + x, 0) / numbers.length;
const meanOf = (budget, key) => mean(budget.runs.map(run => run[key]));
const costOf = budget => meanOf(budget, budgetCost.key);
const budgetText = index => `${plain(results.budgets[index])} ${results.unit}`;

/** The smallest effective sample size among the repetitions; null where none met a medium. */
function sampleSize(budget) {
  const least = Math.min(...budget.runs.map(run => run.effective_sample_size));
  return least > 0 ? least : null;
}

/** Why the bias of a method at a budget is not determined; nothing where it is. */
const biasUnknown = budget => budget.why_bias_unknown;

const kUnknown = {
  value: null,
  lo: null,
  hi: null
};

/**
 * What errors can be: of a method at a budget. Some may be 0: of these an interval that reaches 0 is an upper bound
 * only.
 */
const kMetrics = [
  {name: 'relative MSE', of: budget => budget.relative_mse, noise: scene => scene.reference.relative_mse},
  {name: 'MSE', of: budget => budget.mse},
  {name: '|bias|', of: budget => (biasUnknown(budget) ? kUnknown : magnitude(budget.bias)), mayBeZero: true},
  {
    name: 'squared bias',
    of: budget => budget.squared_bias,
    noise: scene => scene.reference.relative_mse,
    mayBeZero: true
  },
  {name: 'variance', of: budget => ({...kUnknown, value: budget.variance})},
];
