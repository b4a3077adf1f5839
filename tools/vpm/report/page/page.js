// The page put together from the report.
'use strict';

const data = read('data'), encoded = read('pictures');
const report = data.report;

const lastName = path => path.split(/[/\\]/).pop();
const kNoSceneFile =
    'The scene stands in no file, so that no command renders it again: vpm view --scene writes it to one.';
const counted = x => Math.round(x).toLocaleString('en');
const percentOr = x => (x === null ? kNothing : percent(x));

/** Relative MSE, with how well it is known. */
function errorText({error}) {
  if (error === null) return 'not stated: the passes are too few';
  const measured = ({value, standard_error: of}) => `${number(value)} ± ${number(of, 2)}`;
  const parts =
      [`${measured(error)}, below ${number(error.below_with_confidence_of_80_percent)} with a confidence of 80 %`];
  parts.push(`variance ${measured(error.variance)}`);
  if (error.squared_bias)
    parts.push(
        error.squared_bias.seen ?
            `squared bias ${measured(error.squared_bias)}` :
            `squared bias not seen, below ${number(error.squared_bias.below_with_confidence_of_80_percent)}`);
  for (const map of error.bias_not_seen_of) parts.push(`the bias of [${map}] cannot be seen`);
  return parts.join('; ');
}

/** Which pixels were rendered, where these are not all. */
function cropText({width, height, rendered_pixels: {x0, y0, x1, y1}}) {
  if (x1 - x0 === width && y1 - y0 === height) return '';
  return `, of which (${x0}, ${y0}) to (${x1 - 1}, ${y1 - 1}) are rendered and shown`;
}

function facts() {
  return [
    ['Scene', `${report.scene}, hash ${report.scene_hash}`],
    ['Picture', `${report.image}, ${report.width} × ${report.height} pixels${cropText(report)}; ${report.quantity}`],
    ['Relative MSE', errorText(report)],
    ['Time', `${number(report.times.total)} s on ${report.threads} ${report.threads === 1 ? 'thread' : 'threads'}`],
    ['Passes', `${report.passes}, seed ${data.seed}`],
    ['Photons', `${counted(report.photons.emitted)} emitted`],
    ['Memory', `${number(report.memory.peak_of_process / 1e6)} MB at most`],
    ['Program', report.program],
  ];
}

function fillWarnings(place) {
  if (report.warnings.length === 0) return;
  place.append(
      element('h2', {}, report.warnings.length === 1 ? 'Warning' : 'Warnings'),
      element('ul', {class: 'warnings'}, ...report.warnings.map(text => element('li', {}, text))));
}

const kPhotonCounts = [
  ['emitted', 'emitted'],
  ['collisions', 'collisions in media'],
  ['surface_hits', 'hits of surfaces'],
  ['stored_volume', 'stored in media'],
  ['stored_surface', 'stored on surfaces'],
  ['stored_caustic', 'stored for caustics'],
  ['stored_to_guide_gathering', 'stored to guide gathering'],
  ['irradiance_points', 'points of precomputed irradiance'],
  ['flights', 'flights in media recorded'],
  ['stored_beams', 'stored as beams'],
  ['stored_planes', 'stored as planes'],
  ['merged', 'merged into others'],
];

function fillPhotons(section) {
  const {photons, passes, lights} = report;
  const rows = kPhotonCounts.filter(([key]) => photons[key] > 0)
                   .map(([key, name]) => ({cells: [name, counted(photons[key]), counted(photons[key] / passes)]}));
  if (rows.length > 0)
    section.append(
        plainTable('Photons of all passes', ['', 'in all', 'in a pass'], rows),
        element(
            'p', {class: 'muted'},
            `${number(photons.emitted_per_second)} photons emitted and ${
                number(photons.stored_per_second)} stored in a second of tracing.`));
  section.append(plainTable(
      'Lights', ['', 'kind', 'red, W', 'green, W', 'blue, W', 'share of photons'],
      lights.map(
          ({number: i, name, kind, power_W: power, share}) =>
              ({cells: [name || `light ${i}`, kind, ...power.map(x => number(x, 4)), percent(share)]}))));
}

function fillStages(section) {
  const runs = report.stages.filter(line => !line.startsWith('skips ')),
        skips = report.stages.filter(line => line.startsWith('skips '));
  const list = lines => element('ul', {}, ...lines.map(line => element('li', {}, line)));
  section.append(list(runs));
  if (skips.length > 0)
    section.append(element('details', {}, element('summary', {}, `${skips.length} stages were skipped`), list(skips)));
}

function fillTechniques(place) {
  const {techniques} = report;
  if (!techniques) return;
  const column = (title, key, text) => ({title, key: row => row[key], cell: row => text(row[key])});
  place.append(
      element('h3', {}, 'What each technique found'),
      sortableTable(
          'Techniques',
          [
            {title: 'technique', words: true, key: row => row.name, cell: row => row.name},
            column('share of the light', 'share_of_light', percentOr),
            column('found alone', 'found_alone', percentOr),
            column('variance', 'variance', x => number(x ?? null)),
            {
              title: 'what it is',
              words: true,
              key: row => data.techniques[row.name],
              cell: row => data.techniques[row.name]
            },
          ],
          techniques));
}

/** All numbers below a section: [name, number]. */
function countsOf(json, name) {
  if (typeof json === 'number') return [[name, json]];
  if (json === null || typeof json !== 'object') return [];
  return Object.entries(json).flatMap(([key, value]) => countsOf(value, `${name}.${key}`));
}

function fillCounts(section) {
  for (const name of ['photons', 'eye', 'boundaries', 'memory', 'times', 'energy', 'error', 'radii_of_pixels']) {
    const rows = countsOf(report[name], name);
    if (rows.length === 0) continue;
    section.append(element(
        'details', {}, element('summary', {}, name.replaceAll('_', ' ')),
        sortableTable(
            `${name}: counts of all passes`,
            [
              {title: 'key', words: true, key: row => row[0], cell: row => element('code', {}, row[0])},
              {title: 'number', key: row => row[1], cell: row => String(row[1])},
            ],
            rows)));
  }
}

function fillContents() {
  const sections = [...document.querySelectorAll('main section')].filter(section => !section.hidden);
  find('contents')
      .append(...sections.map(
          section =>
              element('li', {}, element('a', {href: `#${section.id}`}, section.querySelector('h2').textContent))));
}

document.title = `${lastName(report.image)}: vpm report`;
find('title').textContent = lastName(report.scene) || lastName(report.image);
fillFacts(find('facts'), facts());
fillWarnings(find('warnings'));
const viewer = new Viewer(
    find('picture'), new Pictures(encoded, encoded.pictures.map(({name}) => name)), encoded.block,
    report.rendered_pixels);
find('about-pictures').textContent = aboutPictures(encoded, report);
fillTechniques(find('techniques'));
fillTime(find('time'), report);
fillPhotons(find('photons'));
fillEnergy(find('energy'), report);
fillStages(find('stages'));
find('about-settings').textContent = aboutSettings(data.settings);
find('settings').append(settingsTable(data.settings));
find('notes').hidden = report.notes.length === 0;
find('notes').append(element('ul', {}, ...report.notes.map(text => element('li', {}, text))));
find('again').append(...(data.commands.length > 0 ? commandList(data.commands) : [element('p', {}, kNoSceneFile)]));
fillCounts(find('counts'));
fillContents();
