// Tables of what was measured.
'use strict';

const data = read('data');
const channels = data.grey ? [''] : [' red', ' green', ' blue'];

/** A column of a flux: its value in one channel, with its standard error. */
function fluxColumn(title, channel, flux) {
  const of = row => {
    const found = flux(row);
    if (!found) return {value: null};
    const value = found.power_W[channel], error = found.standard_error_W[channel];
    return {value, lo: error === null ? null : value - error, hi: error === null ? null : value + error};
  };
  return {title, key: row => of(row).value, cell: row => (flux(row) ? intervalCell(of(row)) : kNothing)};
}

const fluxColumns = (title, flux) => channels.map((name, channel) => fluxColumn(title + name, channel, flux));
const countColumn = (title, flux) =>
    ({title, key: row => flux(row)?.count ?? null, cell: row => (flux(row) ? plain(flux(row).count) : kNothing)});
const nameColumn = {
  title: 'detector',
  words: true,
  key: row => row.name,
  cell: row => row.name
};

function addDetectors() {
  if (data.detectors.length === 0) return;
  const surfaces = data.detectors.filter(row => row.forward), media = data.detectors.filter(row => row.absorbed);
  const columns = [nameColumn];
  for (const side of surfaces.length ? ['forward', 'backward'] : [])
    columns.push(...fluxColumns(side, row => row[side]), countColumn('photons', row => row[side]));
  if (media.length)
    columns.push(...fluxColumns('absorbed', row => row.absorbed), countColumn('collisions', row => row.absorbed));
  find('detectors').append(sortableTable('All detectors', columns, data.detectors));
}

function addParts(detector, side) {
  const rows = detector[side].parts;
  const columns = [
    {title: 'cell', key: row => row.cell[0] * 1e6 + row.cell[1], cell: row => row.cell.join(', ')},
    {title: 'cosine from', key: row => row.cosines[0], cell: row => number(row.cosines[0])},
    {title: 'to', key: row => row.cosines[1], cell: row => number(row.cosines[1])}, ...fluxColumns('power', row => row),
    countColumn('photons', row => row)
  ];
  find('parts').hidden = false;
  find('parts').append(
      element('h3', {}, `${detector.name}, ${side}`), sortableTable(`${detector.name}, ${side}`, columns, rows));
}

function addSlab() {
  if (!data.slab) return;
  const rows = Object.entries(data.slab).map(([name, share]) => ({name, share}));
  const columns = [
    {title: 'share', words: true, key: row => row.name, cell: row => row.name},
    ...fluxColumns('measured', row => ({power_W: row.share.share, standard_error_W: row.share.standard_error})),
    ...channels.map((name, channel) => ({
                      title: 'exact' + name,
                      key: row => row.share.exact[channel],
                      cell: row => number(row.share.exact[channel], 7)
                    }))
  ];
  find('slab').hidden = false;
  find('slab').append(sortableTable('Shares of the light', columns, rows));
}

function addEnergy() {
  const rows = ['emitted', 'absorbed_in_media', 'absorbed_on_surfaces', 'escaped', 'cut_at_max_events'].map(
      key => ({name: key.replaceAll('_', ' '), flux: data[key]}));
  const columns = [
    {title: 'power, W', words: true, key: row => row.name, cell: row => row.name}, ...fluxColumns('W', row => row.flux)
  ];
  find('energy').append(sortableTable('Of all photons', columns, rows));
}

find('title').append(data.scene);
fillFacts(find('facts'), [['Passes', plain(data.passes)], ['Photons', plain(data.photons)]]);
addSlab();
addDetectors();
for (const detector of data.detectors)
  for (const side of ['forward', 'backward'])
    if (detector[side]?.parts) addParts(detector, side);
addEnergy();
