// Live charts of a report, drawn by uPlot, and how keys move in them.

const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const dashes = [undefined, [2, 3], [10, 3, 2, 3]];  // where there are more curves than colours
const isDark = () => window.matchMedia('(prefers-color-scheme: dark)').matches;
const shadeOf = (colour) => (colour === '#0072b2' && isDark() ? '#4aa3df' : colour);
const colourOf = (curve) => shadeOf(colours[curve.colour % colours.length]);
const borderOf = (curve) =>
  (curve.kind === 'theory' ? 'dashed' : ['solid', 'dotted', 'double'][Math.floor(curve.colour / colours.length) % 3]);
const dashOf = (curve) =>
  (curve.kind === 'theory' ? [6, 4] : dashes[Math.floor(curve.colour / colours.length) % dashes.length]);
const chartHeight = 420;
const arrow = 24;  // pixels of a limit's arrow
const whisker = 4;

const isShown = (axis, value) => Number.isFinite(value) && (!axis.logarithmic || value > 0);

/** The abscissae of all curves, and each curve's points in their places. */
function alignedPoints(chart) {
  const x = [...new Set(chart.curves.flatMap((curve) => curve.points.map((point) => point.x)))];
  x.sort((a, b) => a - b);
  const place = new Map(x.map((value, i) => [value, i]));
  const rows = chart.curves.map((curve) => {
    const row = new Array(x.length).fill(null);
    for (const point of curve.points) row[place.get(point.x)] = point;
    return row;
  });
  return {x, rows};
}

/** All of a point, but of an interval that goes far down no more than two decades below it. */
function reachOf(point, axis) {
  const low = axis.logarithmic && point.y !== null ? Math.max(point.low, point.y / 100) : point.low;
  return [point.y, point.high, low];
}

function reach(axis, values) {
  const shown = values.filter((value) => isShown(axis, value));
  if (shown.length === 0) return axis.logarithmic ? [0.1, 1] : [0, 1];
  const least = Math.min(...shown), greatest = Math.max(...shown);
  if (axis.logarithmic && least > 0)
    return [10 ** Math.floor(Math.log10(least)), 10 ** Math.ceil(Math.log10(greatest) - 1e-9)];
  return least === greatest ? [least - 0.5, greatest + 0.5] : [least, greatest];
}

/** A little beyond the first and the last, so that their marks are seen whole. */
function padded([from, to], axis) {
  const margin = 0.02;
  if (axis.logarithmic) return [from * (to / from) ** -margin, to * (to / from) ** margin];
  return [from - margin * (to - from), to + margin * (to - from)];
}

/** Bars for intervals, arrows for limits. */
function drawIntervals(plot, chart, rows) {
  const context = plot.ctx;
  const ratio = window.devicePixelRatio || 1;
  const {left, top, width, height: tall} = plot.bbox;
  context.save();
  context.beginPath();
  context.rect(left, top, width, tall);
  context.clip();
  rows.forEach((row, i) => {
    if (!plot.series[i + 1].show || chart.curves[i].kind !== 'measured') return;
    context.strokeStyle = colourOf(chart.curves[i]);
    context.lineWidth = ratio;
    context.setLineDash([]);
    context.beginPath();
    for (const point of row) {
      if (!point || !(point.high > 0) || (point.low === point.high && !point.is_limit)) continue;
      const x = plot.valToPos(point.x, 'x', true);
      const high = plot.valToPos(point.high, 'y', true);
      const low = point.is_limit ? high + arrow * ratio
                                 : point.low > 0 ? plot.valToPos(point.low, 'y', true) : top + tall;
      const side = whisker * ratio;
      context.moveTo(x - side, high);
      context.lineTo(x + side, high);
      context.moveTo(x, high);
      context.lineTo(x, low);
      context.moveTo(x - side, low - (point.is_limit ? side : 0));
      context.lineTo(x, low);
      context.lineTo(x + side, low - (point.is_limit ? side : 0));
    }
    context.stroke();
  });
  context.restore();
}

function seriesOf(chart) {
  const text = (value) => (value === null || value === undefined ? '-' : value.toPrecision(3));
  return chart.curves.map((curve) => ({
    label: curve.name,
    stroke: () => colourOf(curve),
    dash: dashOf(curve),
    points: {show: curve.kind === 'measured'},
    spanGaps: true,
    value: (plot, value) => text(value),
  }));
}

/** Of 1, 2 and 5 times a power of ten alone; others get in each other's way. */
function logarithmicLabel(value) {
  if (value === null) return '';
  const [digit, exponent] = value.toExponential(6).replace(/\.?0+e/, 'e').split('e');
  if (!['1', '2', '5'].includes(digit)) return '';
  if (exponent >= -2 && exponent <= 4) return String(Number(value.toPrecision(6)));
  return digit === '1' ? `1e${Number(exponent)}` : '';
}

/** Colours of the style sheet, which are others in the dark. */
const styled = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

function axisOf(axis) {
  const faint = {stroke: 'rgba(128, 128, 128, 0.25)', width: 1};
  const common = {label: axis.label, stroke: () => styled('--ink'), grid: faint, ticks: faint};
  return axis.logarithmic ? {...common, values: (plot, marks) => marks.map(logarithmicLabel)} : common;
}

/** Plots as wide as their figure, in the colours of the day or night; the drawing has a name. */
function keepUp(figure, plot, height, name) {
  const canvas = plot.ctx.canvas;
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', name);
  window.addEventListener('resize', () => plot.setSize({width: figure.clientWidth, height}));
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => plot.redraw());
}

function drawLive(figure, chart) {
  const {x, rows} = alignedPoints(chart);
  const values = rows.flat().filter((point) => point).flatMap((point) => reachOf(point, chart.y));
  const whole = {x: padded(reach({}, x), chart.x), y: reach(chart.y, values)};
  const scale = (axis, range) => ({time: false, distr: axis.logarithmic ? 3 : 1, range});
  const plot = new uPlot({
    width: figure.clientWidth,
    height: chartHeight,
    scales: {
      x: scale(chart.x, (u, from, to) => (from === x[0] && to === x.at(-1) ? whole.x : [from, to])),
      y: scale(chart.y, () => whole.y),
    },
    axes: [axisOf(chart.x), axisOf(chart.y)],
    series: [{label: chart.x.label}, ...seriesOf(chart)],
    legend: {markers: {dash: (u, i) => (i > 0 ? borderOf(chart.curves[i - 1]) : 'solid')}},
    hooks: {draw: [(u) => drawIntervals(u, chart, rows)]},
  }, [x, ...rows.map((row) => row.map((point) => (point && !point.is_limit ? point.y : null)))], figure);
  keepUp(figure, plot, chartHeight, `${chart.y.label} over ${chart.x.label}; the table below has its numbers`);
  const view = () => [plot.scales.x.min, plot.scales.x.max];
  const show = ([min, max]) => plot.setScale('x', {min, max});
  listenToKeys(figure, {view, show, whole: whole.x, least: 1e-6, axis: chart.x, name: chart.x.label});
}

/** What a window becomes that grows by shares of itself at both ends: within the whole, not below the least. */
function moved([from, to], [before, after], [first, last], least) {
  const wide = Math.min(Math.max((to - from) * (1 + before + after), least * (last - first)), last - first);
  const begin = (from + to + (after - before) * (to - from) - wide) / 2;
  const within = Math.min(Math.max(begin, first), last - wide);
  return [within, within + wide];
}

/** + and - zoom, arrows pan, 0 shows all. `least`: the narrowest window, as a share of the whole. */
function listenToKeys(figure, {view, show, whole, least, axis, name}) {
  const there = axis.logarithmic ? Math.log : (value) => value;
  const back = axis.logarithmic ? Math.exp : (value) => value;
  const steps = {'+': [-0.25, -0.25], '=': [-0.25, -0.25], '-': [0.5, 0.5],
                 'ArrowLeft': [0.2, -0.2], 'ArrowRight': [-0.2, 0.2]};
  const told = addStatus(figure);
  figure.addEventListener('keydown', (event) => {
    const step = steps[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !(step || event.key === '0')) return;
    event.preventDefault();
    const next = step && moved(view().map(there), step, whole.map(there), least).map(back);
    const isAll = !next || next[1] - next[0] >= (1 - 1e-9) * (whole[1] - whole[0]);
    show(isAll ? whole : next);
    told.textContent = isAll ? 'All is shown' : `${name}: ${next.map((end) => end.toPrecision(4)).join(' to ')}`;
  });
}

/** Where a figure says what is shown to who cannot see it. */
function addStatus(figure) {
  const told = document.createElement('p');
  told.className = 'unseen';
  told.setAttribute('role', 'status');
  told.setAttribute('aria-live', 'polite');
  figure.append(told);
  return told;
}
