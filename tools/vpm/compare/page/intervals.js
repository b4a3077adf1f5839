// What intervals say at one budget: a row for each method, and a line where there is no difference. Drawn by Chart.js.
'use strict';

const kIntervalPlots = [
  {
    title: 'efficiency over that of the best',
    logarithmic: true,
    nothing: 1,
    of: row => (row.isBest ? {value: 1, lo: 1, hi: 1} : row.efficiency),
  },
  {
    title: 'bias of the mean radiance, %',
    logarithmic: false,
    nothing: 0,
    of: row => (biasUnknown(row) ? kUnknown : timesHundred(row.bias)),
  },
];

const kLongestLine = 22, kRowHeight = 26, kLineHeight = 14;  // letters; pixels

/** A name in lines of at most kLongestLine letters, between words where it has any. */
function linesOf(name) {
  const lines = [''];
  for (const word of name.match(new RegExp(`\\S{1,${kLongestLine}}`, 'g')) ?? []) {
    const longer = `${last(lines)} ${word}`.trim();
    if (longer.length <= kLongestLine)
      lines[lines.length - 1] = longer;
    else
      lines.push(word);
  }
  return lines;
}

/** Where a logarithmic axis ends: values, and ends of intervals no further than a factor of 10 beyond all of them. */
function ratioRange(nothing, points) {
  const values = [nothing, ...points.map(p => p.value).filter(x => x > 0)];
  const least = Math.min(...values) / 10, greatest = 10 * Math.max(...values);
  const ends = points.flatMap(p => [p.lo, p.hi]).filter(x => x >= least && x <= greatest);
  return rangeOf([...values, ...ends], 1.3);
}

/** The axis from the least to the greatest end, with what there would be without a difference. */
function intervalAxis({title, logarithmic, nothing}, points) {
  if (logarithmic) return logarithmicAxis(title, ratioRange(nothing, points));
  const ends = [nothing, ...points.flatMap(p => [p.value, p.lo, p.hi]).filter(x => x !== null)];
  const [least, greatest] = [Math.min(...ends), Math.max(...ends)], room = 0.08 * (greatest - least) || 1;
  return {
    type: 'linear',
    min: least - room,
    max: greatest + room,
    title: {display: true, text: title, color: cssColour('--text')},
    ticks: {
      color: cssColour('--text'),
      maxRotation: 0,
      includeBounds: false,
      callback: value => plain(value).replace('-', '−')
    },
    grid: {color: cssColour('--faint'), borderColor: cssColour('--line')},
  };
}

/** Methods from the top. */
const methodAxis = scene => ({
  type: 'linear',
  reverse: true,
  min: -0.6,
  max: scene.methods.length - 0.4,
  afterBuildTicks: axis => {
    axis.ticks = scene.methods.map((_, i) => ({value: i}));
  },
  ticks: {autoSkip: false, color: cssColour('--text'), callback: i => linesOf(scene.methods[i].name)},
  grid: {color: cssColour('--faint'), borderColor: cssColour('--line')},
});

/** The line of no difference, and the intervals, or that there is none. */
const intervalLines = {
  id: 'intervals',
  beforeDatasetsDraw({ctx, chartArea, scales: {x, y}, data, options}) {
    const line = (colour, width, fromX, fromY, toX, toY) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width;
      ctx.beginPath();
      ctx.moveTo(fromX, fromY);
      ctx.lineTo(toX, toY);
      ctx.stroke();
    };
    const reference = x.getPixelForValue(options.nothing);
    line(cssColour('--muted'), 1, reference, chartArea.top, reference, chartArea.bottom);
    for (const {borderColor, data: [p]} of data.datasets) {
      if (p.value === null) writeUnknown(ctx, chartArea.left + 6, y.getPixelForValue(p.y));
      if (p.lo === null || p.hi === null) continue;
      const [from, to] = [p.lo, p.hi].map(end => x.getPixelForValue(Math.min(x.max, Math.max(x.min, end))));
      line(borderColor, 2, from, y.getPixelForValue(p.y), to, y.getPixelForValue(p.y));
    }
  },
};

function writeUnknown(ctx, x, y) {
  ctx.font = 'italic 12px system-ui, sans-serif';
  ctx.fillStyle = cssColour('--muted');
  ctx.textBaseline = 'middle';
  ctx.fillText('not determined', x, y);
}

function intervalDataset(scene, i, point) {
  const {colour, marker} = seriesStyle(i);
  return {
    label: scene.methods[i].name,
    data: [{...point, x: point.value ?? NaN, y: i}],
    borderColor: colour,
    backgroundColor: colour,
    pointStyle: marker,
    pointRadius: 4.5,
    pointBorderWidth: 2,
    pointHitRadius: 10,
  };
}

class IntervalPlot {
  constructor(holder, scene, kind) {
    Object.assign(this, {scene, kind});
    this.canvas = element(
        'canvas', {role: 'img', 'aria-label': `${kind.title} of each method; the table below holds the numbers`});
    const frame = element('div', {}, this.canvas);
    const lines = Math.max(...scene.methods.map(method => linesOf(method.name).length));
    frame.style.height = `${(kRowHeight + kLineHeight * (lines - 1)) * scene.methods.length + 62}px`;
    holder.append(frame);
  }

  /** Of the methods at a budget: rows of the tables. */
  show(rows) {
    this.points = rows.map(this.kind.of);
    this.draw();
  }

  draw() {
    const {scene, kind, points} = this;
    this.chart?.destroy();
    this.chart = new Chart(this.canvas, {
      type: 'scatter',
      plugins: [intervalLines],
      data: {datasets: points.map((point, i) => intervalDataset(scene, i, point))},
      options: {
        animation: false,
        maintainAspectRatio: false,
        devicePixelRatio: Math.max(2, window.devicePixelRatio),
        nothing: kind.nothing,
        scales: {x: intervalAxis(kind, points), y: methodAxis(scene)},
        plugins: {
          legend: {display: false},
          tooltip: {callbacks: {label: ({dataset, raw}) => ` ${dataset.label}: ${interval(raw)}`}}
        },
      },
    });
  }
}
