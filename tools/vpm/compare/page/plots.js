// Error against cost on logarithmic axes, with confidence bands. Drawn by Chart.js.
'use strict';

const kColours = 7;
const kMarkers = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot', 'cross'];
const kDashes = [[], [7, 4], [2, 3], [9, 3, 2, 3]];

const cssColour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** How method `i` looks everywhere: no two of 28 alike, and no two neighbours differ in colour alone. */
function seriesStyle(i) {
  const round = Math.floor(i / kColours);
  return {
    colour: cssColour(`--series-${i % kColours}`),
    marker: kMarkers[(i + round) % kMarkers.length],
    dash: kDashes[round % kDashes.length],
  };
}

/** A piece of a method's line with its marker. */
function drawSwatch(canvas, i) {
  const {colour, marker, dash} = seriesStyle(i);
  const [width, height] = [34, 14], density = Math.max(2, window.devicePixelRatio);
  canvas.width = width * density;
  canvas.height = height * density;
  const context = canvas.getContext('2d');
  context.scale(density, density);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 2;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(0, height / 2);
  context.lineTo(width, height / 2);
  context.stroke();
  context.setLineDash([]);
  Chart.helpers.drawPoint(
      context, {pointStyle: marker, radius: 4.5, rotation: 0, borderWidth: 2}, width / 2, height / 2);
}

function swatch(i) {
  const canvas = element('canvas', {class: 'swatch', 'data-series': i, 'aria-hidden': 'true'});
  drawSwatch(canvas, i);
  return canvas;
}

/** A method's name with its swatch. */
const methodLabel = (scene, i) => element('span', {class: 'method'}, swatch(i), scene.methods[i].name);

/** The points of a method: mean cost, error and its interval; whether the error is drawn, or an upper bound of it. */
function pointsOf(method, metric, cost) {
  return method.budgets.map(budget => {
    const {value, lo, hi} = metric.of(budget);
    const drawn = value > 0 && !(metric.mayBeZero && lo !== null && lo <= 0);
    return {x: meanOf(budget, cost.key), value, lo, hi, drawn, bounded: !drawn && hi > 0};
  });
}

/** The number that a point stands at; nothing where it has no place on a logarithmic axis. */
const heightOf = p => (p.drawn ? p.value : p.bounded ? p.hi : null);

/** Room around positive values, as a factor. */
function rangeOf(values, room) {
  if (values.length === 0) return {min: 0.1, max: 1};
  return {min: Math.min(...values) / room, max: Math.max(...values) * room};
}

/** The axis of errors: all that stands in the plot, with its intervals; lower ends no further than a factor of 10. */
function errorRange(curves) {
  const points = curves.flat().filter(p => heightOf(p) !== null), least = Math.min(...points.map(heightOf));
  const ends =
      points.flatMap(p => (p.drawn ? [p.value, p.lo, p.hi] : [p.hi])).filter(y => y !== null && y >= least / 10);
  return rangeOf(ends, 1.4);
}

/** The datasets of a method: upper and lower end of its band, its line, and upper bounds of what is not above 0. */
function datasetsOf(scene, i, points, bottom) {
  const {colour, marker, dash} = seriesStyle(i);
  const invisible = {borderWidth: 0, pointRadius: 0, pointHitRadius: 0, role: 'band'};
  const end = (p, y) => ({x: p.x, y: p.drawn && y !== null ? Math.max(y, bottom) : NaN});
  const common = {method: i, borderColor: colour, backgroundColor: colour};
  return [
    {...common, ...invisible, data: points.map(p => end(p, p.hi)), fill: '+1', backgroundColor: colour + '26'},
    {...common, ...invisible, data: points.map(p => end(p, p.lo)), fill: false},
    {
      ...common,
      role: 'line',
      label: scene.methods[i].name,
      fill: false,
      borderWidth: 2,
      borderDash: dash,
      pointStyle: marker,
      pointRadius: 4.5,
      pointBorderWidth: 2,
      pointHoverRadius: 6,
      pointHitRadius: 10,
      data: points.map(p => ({...p, y: p.drawn ? p.value : NaN})),
    },
    {
      ...common,
      role: 'bound',
      label: scene.methods[i].name,
      showLine: false,
      fill: false,
      backgroundColor: 'transparent',
      pointStyle: 'triangle',
      rotation: 180,
      pointRadius: 6,
      pointBorderWidth: 2,
      pointHitRadius: 10,
      data: points.map(p => ({...p, y: p.bounded ? p.hi : NaN})),
    },
  ];
}

/** The reference's own noise, where the metric has it and the axis shows it. */
function noiseDatasets(scene, metric, xs, ys) {
  const noise = metric.noise ? metric.noise(scene) : 0;
  if (!(noise > ys.min && noise < ys.max)) return [];
  return [{
    role: 'noise',
    label: 'noise of the reference',
    data: [{x: xs.min, y: noise}, {x: xs.max, y: noise}],
    fill: false,
    borderColor: cssColour('--muted'),
    borderWidth: 1,
    borderDash: [2, 4],
    pointRadius: 0,
    pointHitRadius: 0,
  }];
}

/** Whiskers: intervals through the points, to be seen where bands overlap or there is one budget only. */
const whiskers = {
  id: 'whiskers',
  beforeDatasetsDraw(chart) {
    const {ctx, chartArea, scales: {x, y}} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(chartArea.left, chartArea.top, chartArea.width, chartArea.height);
    ctx.clip();
    chart.data.datasets.forEach((dataset, index) => {
      if (dataset.role !== 'line' || !chart.isDatasetVisible(index)) return;
      ctx.strokeStyle = dataset.borderColor;
      ctx.lineWidth = 1;
      for (const p of dataset.data.filter(q => !Number.isNaN(q.y) && q.lo !== null && q.hi !== null)) {
        ctx.beginPath();
        ctx.moveTo(x.getPixelForValue(p.x), y.getPixelForValue(p.hi));
        ctx.lineTo(x.getPixelForValue(p.x), p.lo > 0 ? y.getPixelForValue(p.lo) : chartArea.bottom);
        ctx.stroke();
      }
    });
    ctx.restore();
  },
};

/** Which multiples of powers of ten may be labelled: of these, the first for which there is room. */
const kLabelled = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 5], [1]];

/** Whether an axis of that range writes its numbers without powers of ten. */
const isPlain = ({min, max}) => min > 0.005 && max < 50000;

/** The multiples of powers of ten in a range that have these leading digits, from the least. */
function multiplesIn({min, max}, digits) {
  const multiples = [];
  for (let exponent = exponentOf(min); 10 ** exponent <= max; ++exponent)
    multiples.push(...digits.map(digit => digit * 10 ** exponent).filter(x => x >= min && x <= max));
  return multiples;
}

/** The leading digits that are labelled on an axis `length` pixels long, where a label takes `room` of them. */
function labelledDigits(range, length, room) {
  const pixels = length / Math.log10(range.max / range.min);  // of a decade
  const fits = digits =>
      multiplesIn(range, digits).every((x, i, all) => i === 0 || pixels * Math.log10(x / all[i - 1]) >= room);
  const finest = kLabelled.findIndex(fits);
  const telling = kLabelled.findLastIndex(digits => multiplesIn(range, digits).length > 1);  // one label is no scale
  return kLabelled[Math.max(0, Math.min(finest, telling))];
}

/** Powers of ten are labelled, and what between them there is room for. */
function tickText(value, range, digits) {
  const exponent = exponentOf(value), leading = value / 10 ** exponent, digit = Math.round(leading);
  if (Math.abs(leading - digit) > 1e-6 || !digits.includes(digit)) return '';
  if (isPlain(range)) return plain(digit * 10 ** exponent);
  return (digit === 1 ? '' : `${digit}\u202f×\u202f`) + `10${superscript(exponent)}`;
}

/** Of a scale of Chart.js. */
function textOfTick(scale, value, range) {
  const room = !scale.isHorizontal() ? 20 : isPlain(range) ? 44 : 60;
  return tickText(value, range, labelledDigits(range, scale.isHorizontal() ? scale.width : scale.height, room));
}

function logarithmicAxis(title, range) {
  const isPower = value => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6;
  return {
    type: 'logarithmic',
    ...range,
    title: {display: true, text: title, color: cssColour('--text')},
    ticks: {
      color: cssColour('--text'),
      maxRotation: 0,
      autoSkip: false,
      callback(value) { return textOfTick(this, value, range); },
    },
    grid: {
      color: line => cssColour(line.tick && isPower(line.tick.value) ? '--line' : '--faint'),
      tickColor: cssColour('--line'),
      borderColor: cssColour('--line'),
    },
  };
}

function tooltipText({dataset, raw}) {
  const value = raw.lo === null ? number(raw.value) : interval(raw);
  return ` ${dataset.label}: ${value} at ${number(raw.x)}`;
}

const plotOptions = (metric, cost, xs, ys) => ({
  animation: false,
  maintainAspectRatio: false,
  normalized: true,
  parsing: false,
  devicePixelRatio: Math.max(2, window.devicePixelRatio),
  interaction: {mode: 'nearest', intersect: true},
  scales: {x: logarithmicAxis(cost.title, xs), y: logarithmicAxis(metric.name, ys)},
  plugins: {
    legend: {display: false},
    tooltip: {
      filter: item => ['line', 'bound'].includes(item.dataset.role),
      callbacks: {title: () => '', label: tooltipText}
    },
  },
});

/** What of the numbers the plot cannot show, in words. */
function plotNote(scene, metric, curves, ys) {
  const namesWhere = holds =>
      scene.methods.filter((_, i) => curves[i].some(holds)).map(method => method.name).join(', ');
  const unknown = namesWhere(p => heightOf(p) === null),
        cut = namesWhere(p => p.drawn && p.lo !== null && p.lo < ys.min);
  const noise = metric.noise ? metric.noise(scene) : 0;
  const notes =
      [curves.flat().some(p => p.lo !== null) ? 'Bands and whiskers: 95 % confidence intervals.' :
                                                'No interval is computed for this error.'];
  if (namesWhere(p => p.bounded))
    notes.push('▽: the upper end of an interval that reaches 0; the error may be none at all.');
  if (cut) notes.push(`Intervals that reach the bottom go on below it: ${cut}.`);
  if (unknown) notes.push(`Not determined at some budget: ${unknown}.`);
  if (noise > 0)
    notes.push(`The reference has a relative MSE of ${number(noise)} itself${
        noise > ys.min ? ' (dotted)' : ''}; that is subtracted.`);
  return notes.join(' ');
}

/** The plot of a scene, its choices and its legend. */
class ErrorPlot {
  constructor(root, scene) {
    this.root = root;
    this.scene = scene;
    this.hidden = new Set();  // methods
    this.canvas = root.querySelector('.plot canvas');
    fillSelect(root.querySelector('.metric'), kMetrics.map(metric => metric.name));
    fillSelect(root.querySelector('.cost'), kCosts.map(cost => cost.title), kCosts.indexOf(budgetCost));
    for (const select of root.querySelectorAll('.metric, .cost')) select.addEventListener('change', () => this.draw());
    root.querySelector('.save-plot').addEventListener('click', () => this.save());
    this.fillLegend();
    this.draw();
  }

  get metric() { return kMetrics[this.root.querySelector('.metric').value]; }
  get cost() { return kCosts[this.root.querySelector('.cost').value]; }

  draw() {
    const {scene, metric, cost} = this;
    const curves = scene.methods.map(method => pointsOf(method, metric, cost));
    const shown = curves.filter((_, i) => !this.hidden.has(i));
    const xs = rangeOf(shown.flat().map(p => p.x).filter(x => x > 0), 1.25), ys = errorRange(shown);
    const datasets = curves.flatMap((points, i) => (this.hidden.has(i) ? [] : datasetsOf(scene, i, points, ys.min)));
    this.chart?.destroy();
    this.chart = new Chart(this.canvas, {
      type: 'line',
      plugins: [whiskers],
      options: plotOptions(metric, cost, xs, ys),
      data: {datasets: [...datasets, ...noiseDatasets(scene, metric, xs, ys)]},
    });
    this.canvas.setAttribute(
        'aria-label', `${metric.name} against ${cost.title} for each method; the tables below hold the numbers`);
    this.root.querySelector('.plot-note').textContent = plotNote(scene, metric, curves, ys);
  }

  fillLegend() {
    const legend = this.root.querySelector('.legend');
    legend.setAttribute('aria-label', 'Methods in the plot');
    this.scene.methods.forEach((method, i) => {
      const slope = element('span', {class: 'muted'}, `slope ${interval(method.slope)}`);
      const button = element('button', {type: 'button', 'aria-pressed': 'true'}, methodLabel(this.scene, i), slope);
      button.addEventListener('click', () => this.toggle(button, i));
      legend.append(button);
    });
    legend.append(element(
        'p', {class: 'muted'},
        `Slopes are those of log relative MSE over log cost in ${results.unit}: ` +
            '−1 is variance alone, 0 is bias alone. A click takes a method out of the plot.'));
  }

  toggle(button, i) {
    const shown = this.hidden.delete(i);
    if (!shown) this.hidden.add(i);
    button.setAttribute('aria-pressed', String(shown));
    this.draw();
  }

  /** As a picture with a white ground, whatever the page's colours are now. */
  save() {
    withLightColours(() => {
      this.draw();
      const picture = document.createElement('canvas');
      [picture.width, picture.height] = [this.canvas.width, this.canvas.height];
      const context = picture.getContext('2d');
      context.fillStyle = 'white';
      context.fillRect(0, 0, picture.width, picture.height);
      context.drawImage(this.canvas, 0, 0);
      element('a', {href: picture.toDataURL('image/png'), download: `${this.scene.name}.png`}).click();
    });
    this.draw();
  }
}
