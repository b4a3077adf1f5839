// Which methods are biased: verdicts at the last budget, on all methods and scenes of the experiment together.
'use strict';

const besideBaseline = () => (results.baseline === null ? '' : ` beside ${results.baseline}`);

/** That a method is biased is not said by colour alone. */
function verdictCell({says, why}) {
  if (says === 'biased') return element('strong', {class: 'biased'}, says);
  return says === 'not determined' ? `${says}: ${why}` : says;
}

function verdictsTable(scene) {
  const budget = results.budgets.length - 1, f = results.formulas;
  const columns = [
    methodColumn(scene),
    {
      title: 'verdict',
      hint: f.verdict,
      words: true,
      key: row => row.verdict.says,
      cell: row => verdictCell(row.verdict)
    },
    ...(results.baseline === null ? [biasColumn()] : ownBiasColumns()),
    numberColumn('p', 'of a bias so far from 0, were there none', row => row.verdict.p, p => number(p, 2)),
    numberColumn('p (Holm)', f.verdict, row => row.verdict.p_holm, p => number(p, 2)),
  ];
  const rows = rowsAt(scene, budget).map(row => ({...row, verdict: scene.methods[row.index].verdict}));
  return sortableTable(`Verdicts on bias${besideBaseline()} at ${budgetText(budget)}`, columns, rows, 4);
}

function verdictsText({methods}) {
  const those = says => methods.filter(method => method.verdict.says === says).length;
  const judged = methods.filter(method => method.verdict.p !== null).length;
  const unknown = those('not determined'), {rate, count} = results.verdicts;
  return `${those('biased')} of ${judged} methods that are judged are biased${besideBaseline()}` +
      (unknown > 0 ? `; not determined: ${unknown}. ` : '. ') +
      `One or more of the ${count} verdicts of the experiment are wrong in at most ${plain(100 * rate)}\u202f% of ` +
      'experiments without a bias.';
}
