// Parts of a whole: a bar, and a table of the same numbers.
'use strict';

const colourOf = i => `var(--series-${i % 7})`;

const swatchOf = i => {
  const made = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  made.style.background = colourOf(i);
  return made;
};

/** A bar of parts {name, value}, of which those above 0 have a length. */
function barOf(parts, label) {
  const bar = element('div', {class: 'bar', role: 'img', 'aria-label': label});
  const all = parts.reduce((sum, {value}) => sum + Math.max(0, value), 0);
  parts.forEach(({name, value}, i) => {
    if (!(value > 0)) return;
    const part = element('span', {title: name});
    part.style.flexGrow = 100 * value / all;  // factors that sum to less than 1 would leave a part of the bar empty
    part.style.background = colourOf(i);
    bar.append(part);
  });
  return bar;
}

/**
 * A table of rows: texts, of which the first is the head; `marks` of a row is the number of its colour, if it has one.
 */
function plainTable(caption, heads, rows) {
  const cell = (tag, text, i, mark) => element(
      tag, {class: i === 0 ? 'words' : 'number', ...(tag === 'th' ? {scope: i === 0 ? 'row' : 'col'} : {})},
      ...(mark === undefined ? [] : [swatchOf(mark)]), text);
  const head = element(
      'tr', {}, ...heads.map((text, i) => element('th', {scope: 'col', class: i === 0 ? 'words' : 'number'}, text)));
  const body = rows.map(
      ({cells, mark, kind = ''}) => element(
          'tr', {class: kind},
          ...cells.map((text, i) => cell(i === 0 ? 'th' : 'td', text, i, i === 0 ? mark : undefined))));
  return element(
      'div', {class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption},
      element(
          'table', {class: 'plain'}, element('caption', {}, caption), element('thead', {}, head),
          element('tbody', {}, ...body)));
}

const kStages = [
  ['importance', 'importance: importons traced from the eye'],
  ['photon_tracing', 'photon tracing'],
  ['caustic_tracing', 'photons traced to caustics'],
  ['map_building', 'photon maps built'],
  ['eye_pass', 'eye rays: gathering, shadow rays, paths'],
];

/** The stages of all passes, and what is left of the total. */
function timeParts({times}) {
  const stages = kStages.map(([key, name]) => ({name, value: times[key]}));
  const rest = times.total - stages.reduce((sum, {value}) => sum + value, 0);
  return [...stages, {name: 'the rest: choosing settings, sums of passes', value: rest}];
}

function fillTime(section, report) {
  const parts = timeParts(report), {times, passes} = report,
        share = x => (times.total > 0 ? percent(x / times.total) : kNothing);
  const rows =
      parts.map(({name, value}, mark) => ({mark, cells: [name, number(value), number(value / passes), share(value)]}));
  rows.push({kind: 'sum', cells: ['all', number(times.total), number(times.total / passes), share(times.total)]});
  section.append(
      barOf(parts, 'Stages by their time'),
      plainTable('Wall clock time of all passes', ['stage', 's', 's in a pass', 'share'], rows));
}

const kFlows = [
  ['absorbed_in_media', 'absorbed in media'],
  ['absorbed_on_surfaces', 'absorbed on surfaces'],
  ['escaped', 'escaped from the scene'],
  ['cut_at_max_events', 'cut at the limit of events'],
];

const sumOf = numbers => numbers.reduce((sum, x) => sum + x, 0);

/** What became of what photons carry, and what is missing: in W, channel by channel. */
function energyLedger({energy}) {
  const flows = kFlows.map(([key, name]) => ({name, channels: energy[key], value: sumOf(energy[key])}));
  const found = [0, 1, 2].map(c => sumOf(flows.map(({channels}) => channels[c])));
  return {flows, found, emitted: energy.emitted, residual: found.map((x, c) => x - energy.emitted[c])};
}

function fillEnergy(section, report) {
  const {energy, photons} = report;
  if (photons.emitted === 0) {
    section.append(element('p', {}, 'No photons were emitted.'));
    return;
  }
  const {flows, found, emitted, residual} = energyLedger(report), all = sumOf(emitted);
  const row = (name, channels, more) =>
      ({cells: [name, ...channels.map(x => number(x, 4)), percent(sumOf(channels) / all)], ...more});
  section.append(
      barOf(flows, 'What became of the energy'),
      plainTable(
          'Power, W, as photons carried it', ['', 'red', 'green', 'blue', 'of what was emitted'],
          [
            ...flows.map(({name, channels}, mark) => row(name, channels, {mark})),
            row('all of these', found, {kind: 'sum'}), row('emitted', emitted),
            row('residual: these less emitted', residual)
          ]),
      element('p', {class: 'muted'}, imbalanceText(energy)));
}

function imbalanceText(energy) {
  const {value, standard_error: error} = energy.imbalance;
  if (error.every(e => e === 0)) return 'No photon lost or gained any energy on its way.';
  const channels = value.map((v, c) => `${number(v)} ± ${number(error[c], 2)}`);
  return `The residual over what is emitted, in red, green and blue: ${
             channels.join(', ')}. Photons may gain and lose ` +
      'energy on their way, but not on average.';
}
