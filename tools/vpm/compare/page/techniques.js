// What the techniques of the combined estimator find, for methods that keep their layers.
'use strict';

/** Techniques of all methods, in the order of their pictures, each with its method. */
const techniquesOf = scene =>
    scene.methods.flatMap(({name, techniques}, index) => techniques.map(t => ({...t, method: name, index})));

/** Groups of pictures, of which the first has that number. */
function techniqueGroups(scene, first) {
  const all = techniquesOf(scene);
  return scene.methods.filter(({techniques}) => techniques.length > 0)
      .map(({name}) => ({
             title: `What each technique of ${name} finds: parts that sum to its first run`,
             members: all.flatMap(({method}, i) => (method === name ? [first + i] : []))
           }));
}

function techniquesTable(scene) {
  const f = results.formulas, inPercent = x => number(times(x, 100));
  const columns = [
    methodColumn(scene),
    {title: 'technique', words: true, key: row => row.name, cell: row => row.name},
    numberColumn('share of the light, %', f.share_of_light, row => row.share_of_light, inPercent),
    numberColumn('found alone, %', f.found_alone, row => row.found_alone, inPercent),
    numberColumn('variance', f.variance_of_technique, row => row.variance),
  ];
  const rows = techniquesOf(scene).sort((a, b) => b.share_of_light - a.share_of_light);
  const budget = budgetText(results.budgets.length - 1);
  return sortableTable(`What each technique finds at ${budget}: means over repetitions`, columns, rows);
}
