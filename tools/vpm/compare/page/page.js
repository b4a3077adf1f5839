// The page put together: each scene's plot, tables and pictures, and the texts behind them.
'use strict';

function provenance() {
  const {machine} = results;
  return [
    ['vpm', results.vpm],
    ['Machine', `${machine.processor}, ${machine.cores} cores, ${machine.threads} threads used; ${machine.system}`],
    ['Repetitions', `${results.repetitions}, seeds ${results.seed} to ${results.seed + results.repetitions - 1}`],
    ['Budgets', `${results.budgets.map(plain).join(', ')} ${results.unit}`],
    ['Methods', String(results.scenes[0].methods.length)],
    ...(results.baseline === null ? [] : [['Baseline', `${results.baseline}, whose bias all methods share`]]),
  ];
}

/** The best method at the last budget, and what it is better than. */
function finding(scene) {
  const best = last(scene.best), others = scene.methods.map((_, i) => i).filter(i => i !== best);
  const efficiency = i => last(scene.methods[i].budgets).efficiency;
  const next = others.reduce((a, b) => ((efficiency(b).value ?? 0) > (efficiency(a).value ?? 0) ? b : a));
  const beaten = scene.pairs.filter(pair => isSignificant(pair) && betterOf(pair) === best).length;
  const ofNext = efficiency(next).value === null ?
      '' :
      `The next, ${scene.methods[next].name}, is ${interval(efficiency(next))} times as efficient. `;
  return `At ${budgetText(results.budgets.length - 1)}, ${
             scene.methods[best].name} has the smallest relative MSE × cost. ${ofNext}` +
      `Significantly less efficient: ${beaten} of the ${others.length} others (at most 5 % family-wise, all pairs).`;
}

/** The scene's pictures with their names, and what the tables say of each. */
function namedPictures(scene, encoded) {
  const budget = method => last(method.budgets), budgets = budgetText(results.budgets.length - 1);
  const names = [
    'reference', ...scene.methods.map(m => m.name),
    ...scene.methods.map(m => `${m.name}, mean of ${results.repetitions}`),
    ...techniquesOf(scene).map(({method, name}) => `${method}, ${name}`)
  ];
  const pictures = new Pictures(encoded, names);
  pictures.remarks = [
    scene.reference.relative_mse > 0 ? `relative MSE ${number(scene.reference.relative_mse)}` : 'taken to be exact',
    ...scene.methods.map(m => `relative MSE ${number(budget(m).runs[0].relative_mse)}`),
    ...scene.methods.map(m => `squared bias ${interval(budget(m).squared_bias)}`),
    ...techniquesOf(scene).map(technique => `${percent(technique.share_of_light)} of the light`),
  ];
  const numbers = names.map((_, i) => i), runs = 1 + scene.methods.length, means = runs + scene.methods.length;
  pictures.groups = [
    {title: `The reference, and the first run of each method at ${budgets}`, members: numbers.slice(0, runs)},
    {
      title: `Means of ${results.repetitions} repetitions: the more of these, the more of what is left is bias`,
      members: numbers.slice(runs, means)
    },
    ...techniqueGroups(scene, means),
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
  part('.reference-text').textContent =
      `Reference: ${scene.reference.source}. ${scene.width} × ${scene.height} pixels. Scene file: ${scene.file}`;
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
  part('.verdicts-text').textContent = verdictsText(scene);
  part('.verdicts').append(verdictsTable(scene));
  if (techniquesOf(scene).length > 0)
    part('.techniques').append(element('h3', {}, 'Techniques'), techniquesTable(scene));
  part('.equal-error').append(equalErrorTable(scene));
  part('.pairs-text').textContent = pairsText(scene);
  part('.pairs').append(pairsTable(scene));
  return new Comparer(part('.comparer'), scene, namedPictures(scene, encoded), index);
}

/** The overrides of a method, and all settings they lead to on each scene. */
function methodTexts() {
  return results.scenes[0].methods.map((method, m) => {
    const scenes = results.scenes.map(
        scene => `${scene.name} (scene hash ${scene.methods[m].scene_hash})\n${
            scene.methods[m].settings.split(' ').map(s => `  ${s}`).join('\n')}`);
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
  matchMedia('print').addEventListener('change', recolour);  // where the layout is already that of paper
  window.addEventListener('beforeprint', () => {
    root.add('light');
    recolour();
  });
  window.addEventListener('afterprint', () => {
    root.remove('light');
    recolour();
  });
}

document.title = find('title').textContent = results.title;
fillFacts(find('provenance'), provenance());
fillContents();
const encodedPictures = read('pictures');
const comparers = results.scenes.map((scene, i) => buildScene(scene, i, encodedPictures[i]));
find('method-texts').append(...methodTexts());
find('distance-strategies').append(aboutTable('Distance strategies', about.distance));
find('transmittance-estimators').append(aboutTable('Transmittance estimators', about.transmittance));
fillFacts(
    find('formula-list'), Object.entries(results.formulas).map(([name, text]) => [name.replaceAll('_', ' '), text]));
find('file-texts').append(...fileTexts());
find('save-results').addEventListener('click', saveResults);
followColours();
