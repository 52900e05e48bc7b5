// Live charts of a report, drawn by uPlot, and how keys move in them.

// Those of the still pictures (svg.cpp), the first one lighter in the dark.
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const inDark = {'#0072b2': '#4aa3df'};
const grey = 'rgba(136, 136, 136, .45)';
const isDark = () => window.matchMedia('(prefers-color-scheme: dark)').matches;
const shadeOf = (colour) => (isDark() && inDark[colour]) || colour;
/** Of more than six curves the others are grey, but for the one that is pointed at. */
const isGrey = (curve) => curve.colour === null && !curve.isPicked;
const colourOf = (curve) => (curve.colour === null ? styled('--ink') : shadeOf(colours[curve.colour]));
const dashOf = (curve) => (curve.kind === 'theory' ? [6, 4] : undefined);
const chartHeight = 420;
const plotHeight = 320;  // of it, without what stands at the axes
const whisker = 4;

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

/** Whether a curve goes through a point; it is broken at limits. */
const isThrough = (point, chart) => !point.is_limit && isShown(chart.x, point.x) && isShown(chart.y, point.y);

/**
 * A curve's ordinates as uPlot has them: null breaks it, undefined does not. Abscissae that other curves alone have
 * break it where one of its own points beside them does.
 */
function ordinates(row, chart) {
  const y = row.map((point) => (point ? (isThrough(point, chart) ? point.y : null) : undefined));
  for (const i of y.keys()) if (y[i] === undefined && y[i - 1] === null) y[i] = null;
  for (const i of [...y.keys()].reverse()) if (y[i] === undefined && y[i + 1] === null) y[i] = null;
  return y;
}

/** Bars for intervals, arrows for limits. */
function drawIntervals(plot, chart, rows) {
  const context = plot.ctx;
  const ratio = pixelRatio();
  const {left, top, width, height: tall} = plot.bbox;
  context.save();
  context.beginPath();
  context.rect(left, top, width, tall);
  context.clip();
  rows.forEach((row, i) => {
    const curve = chart.curves[i];
    if (!plot.series[i + 1].show || isGrey(curve) || !['measured', 'bars'].includes(curve.kind)) return;
    context.strokeStyle = curve.kind === 'bars' ? styled('--ink') : colourOf(curve);
    context.lineWidth = ratio;
    context.setLineDash([]);
    context.beginPath();
    for (const point of row) {
      if (!point || !(point.high > 0) || (point.low === point.high && !point.is_limit)) continue;
      const x = plot.valToPos(point.x, 'x', true);
      const high = plot.valToPos(point.high, 'y', true);
      const low = point.is_limit ? Math.min(high + arrow * ratio, top + tall)
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

/** A line across, named at its right end. */
function drawLevel(plot, {level}) {
  if (!level || level.at < plot.scales.y.min || level.at > plot.scales.y.max) return;
  const context = plot.ctx, ratio = pixelRatio();
  const y = plot.valToPos(level.at, 'y', true), right = plot.bbox.left + plot.bbox.width;
  context.save();
  context.strokeStyle = context.fillStyle = styled('--ink');
  context.lineWidth = ratio;
  context.setLineDash([ratio, 3 * ratio]);
  context.beginPath();
  context.moveTo(plot.bbox.left, y);
  context.lineTo(right, y);
  context.stroke();
  context.font = `${11 * ratio}px sans-serif`;
  context.textAlign = 'right';
  context.fillText(level.text, right - 4 * ratio, y - 4 * ratio);
  context.restore();
}

const roomForNames = 480;  // pixels of a plot's width; the narrower has its legend alone

/**
 * Adds names beside their curves: those that the still picture has, in the same places, while all is shown. Gives back
 * what puts them there, to be called whenever the curves are drawn.
 */
function addNames(plot, chart, isWhole) {
  const names = chart.labels.map(({name, is_left, is_above}) => {
    const words = document.createElement('span');
    words.className = `name ${is_left ? 'left' : 'right'} ${is_above ? 'above' : 'below'}`;
    words.textContent = name;
    words.setAttribute('aria-hidden', 'true');  // the legend tells it
    plot.over.append(words);
    return words;
  });
  return () => chart.labels.forEach(({curve, point, along}, i) => {
    const {points} = chart.curves[curve], ends = [points[point], points[point + 1] || points[point]];
    const [x, y] = ['x', 'y'].map((axis) => {
      const [from, to] = ends.map((end) => plot.valToPos(end[axis], axis));
      return along > 0 ? from + along * (to - from) : from;
    });
    Object.assign(names[i].style, {left: `${x}px`, top: `${y}px`});
    names[i].hidden = !plot.series[curve + 1].show || !isWhole() || plot.over.clientWidth < roomForNames;
  });
}

/** Two digits, or three where half the interval is at most a tenth of the value, as tables have them. */
const digitsOf = ({y, low, high}) => ((high - low) / 2 / y <= 0.1 ? 3 : 2);

/** A point in the legend. */
function told(point) {
  if (!point || !Number.isFinite(point.is_limit ? point.high : point.y)) return '-';
  const text = (value, digits) => String(Number.isInteger(value) ? value : Number(value.toPrecision(digits)));
  if (point.is_limit) return `< ${text(point.high, 2)}`;
  if (point.low === point.high) return text(point.y, 3);
  return `${text(point.y, digitsOf(point))} [${[point.low, point.high].map((end) => text(end, digitsOf(point))).join(', ')}]`;
}

/** Several theories have one line in the legend; their values stand beside those of their curves. */
const hasSeveralTheories = (chart) => chart.curves.filter((curve) => curve.kind === 'theory').length > 1;

/** Marks stand alone where a theory goes through them, so that its line is seen. */
const hasLine = (chart, curve) => curve.kind !== 'measured'
  || !chart.curves.some((other) => other.kind === 'theory' && other.colour === curve.colour);

/** Where the theory of a curve is that has no line of its own. */
const theoryOf = (chart, curve) => (curve.kind === 'theory' || !hasSeveralTheories(chart) ? -1
  : chart.curves.findIndex((other) => other.kind === 'theory' && other.colour === curve.colour));

function seriesOf(chart, rows) {
  return chart.curves.map((curve, k) => ({
    label: curve.name,
    class: curve.colour === null || (curve.kind === 'theory' && hasSeveralTheories(chart)) ? 'folded' : null,
    stroke: () => (isGrey(curve) ? grey : colourOf(curve)),
    dash: dashOf(curve),
    points: {show: () => curve.kind === 'measured' && !isGrey(curve)},
    ...(!hasLine(chart, curve) && {paths: () => null}),
    ...(curve.kind === 'bars' && {paths: uPlot.paths.bars({size: [0.6, 60]}), fill: () => colourOf(curve)}),
    value: (plot, value, series, i) => {
      const theory = rows[theoryOf(chart, curve)];
      return told(rows[k][i]) + (theory && theory[i] ? `, theory ${told(theory[i])}` : '');
    },
  }));
}

/** A curve that is hidden takes its theory along. */
function hideTheory(plot, chart, i, {show}) {
  const theory = i > 0 && show !== undefined ? theoryOf(chart, chart.curves[i - 1]) : -1;
  if (theory >= 0 && plot.series[theory + 1].show !== show) plot.setSeries(theory + 1, {show});
}

function swatchOf(chart, curve) {
  const style = `stroke: ${colourOf(curve)}; stroke-dasharray: ${(dashOf(curve) || ['none']).join(' ')}`;
  const mark = hasLine(chart, curve) ? '' : `<circle cx="18" cy="6" r="2.5" style="fill: ${colourOf(curve)}"/>`;
  const line = hasLine(chart, curve) ? `<line x2="36" y1="6" y2="6" style="${style}"/>` : '';
  return `<svg viewBox="0 0 36 12" aria-hidden="true">${line}${mark}</svg>`;
}

/** Of grey curves the last that was pointed at, or tapped, has its intervals and its line in the legend. */
function pick(plot, chart, k) {
  const curve = chart.curves[k];
  if (!curve || curve.colour !== null || curve.isPicked) return;
  const rows = plot.root.querySelectorAll('.u-legend .u-series');
  chart.curves.forEach((other, i) => {
    if (other.colour !== null) return;
    other.isPicked = i === k;
    rows[i + 1].classList.toggle('folded', !other.isPicked);
  });
  plot.redraw();
}

const hasGrey = (chart) => chart.curves.some((curve) => curve.colour === null);

function sayWhatIsGrey(figure, chart) {
  const more = chart.curves.filter((curve) => curve.colour === null && curve.kind !== 'theory').length;
  const curves = more === 1 ? '1 more curve is' : `${more} more curves are`;
  addNote(figure, 'greyed', `${curves} grey: point at one, or tap it, for its name and numbers`);
}

/** Lines of the curves' colours, dashes and marks in the legend. */
function drawSwatches(plot, chart) {
  const markers = [...plot.root.querySelectorAll('.u-marker')].slice(1);  // the first is that of x
  chart.curves.forEach((curve, i) => { markers[i].innerHTML = swatchOf(chart, curve); });
}

/** Curves are hidden and shown by their names in the legend, by the keyboard too. */
function makePressable(plot) {
  plot.root.querySelectorAll('.u-legend .u-series th').forEach((name, i) => {
    if (i === 0) return;  // that of x
    name.tabIndex = 0;
    name.setAttribute('role', 'button');
    const tell = () => name.setAttribute('aria-pressed', plot.series[i].show);
    tell();
    name.addEventListener('click', tell);
    name.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      name.click();
    });
  });
}

function addNote(figure, name, words) {
  const line = document.createElement('p');
  line.className = `hint ${name}`;
  line.textContent = words;
  figure.append(line);
}

/** Plots as wide as their figure, in the colours of the day or night; the drawing has a name. */
function keepUp(figure, plot, height, name) {
  const canvas = plot.ctx.canvas;
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', name);
  window.addEventListener('resize', () => plot.setSize({width: figure.clientWidth, height}));
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => plot.redraw());
}

/** Bars have room beside the first and the last: half of the way to the next. */
function besideBars(chart, x) {
  if (chart.curves.every((curve) => curve.kind !== 'bars')) return [];
  const half = x.length > 1 ? Math.min(...x.slice(1).map((value, i) => value - x[i])) / 2 : 0.5;
  return [x[0] - half, x.at(-1) + half];
}

/** The ends for which uPlot asks when it shows all abscissae. */
function askedForAll(axis, x) {
  if (x.length > 1) return [x[0], x.at(-1)];
  return axis.logarithmic ? uPlot.rangeLog(x[0], x[0], 10, false) : uPlot.rangeNum(x[0], x[0], 0.1, true);
}

function drawLive(figure, chart) {
  const {x, rows} = alignedPoints(chart);
  const points = rows.flat().filter((point) => point), ends = points.flatMap((point) => endsOf(point, chart.y));
  const values = [...points.map((point) => (point.is_limit ? point.high : point.y)), ...aboutLevel(chart.y),
                  ...(chart.y.from_zero ? [0] : [])];
  const limits = points.filter((point) => point.is_limit && point.high > 0).map((point) => point.high);
  const whole = {x: reachAcross(chart.x, [...x, ...besideBars(chart, x)]),
                 y: reach(chart.y, values, ends, limits, arrow / plotHeight)};
  const all = askedForAll(chart.x, x);
  const scale = (axis, range) => ({time: false, distr: axis.logarithmic ? 3 : 1, range});
  const plot = new uPlot({
    width: figure.clientWidth,
    height: chartHeight,
    scales: {
      x: scale(chart.x, (u, from, to) => (from === all[0] && to === all[1] ? whole.x : [from, to])),
      y: scale(chart.y, () => whole.y),
    },
    axes: [{...axisOf(chart.x), ...marksFor(chart.x), ...lowerMarks(chart.x)},
           {...axisOf(chart.y), ...marksFor(chart.y), size: widthFor}],
    series: [{label: chart.x.label}, ...seriesOf(chart, rows)],
    cursor: {dataIdx: (u, series, i) => i, bind: onlyWithoutShift, ...(hasGrey(chart) && {focus: {prox: 24}})},
    focus: {alpha: 1},
    legend: {markers: {width: 0}},
    hooks: {setSeries: [(u, i, change) => hideTheory(u, chart, i, change),
                        (u, i, change) => { if (change.focus && i !== null) pick(u, chart, i - 1); }],
            draw: [(u) => drawLevel(u, chart.y), (u) => drawIntervals(u, chart, rows),
                   (u) => drawSwatches(u, chart)]},
  }, [x, ...rows.map((row) => ordinates(row, chart))], figure);
  if (hasSeveralTheories(chart)) addNote(figure, 'dashed', 'dashed: theory');
  if (hasGrey(chart)) sayWhatIsGrey(figure, chart);
  keepUp(figure, plot, chartHeight, `${chart.y.label} over ${chart.x.label}; the table below has its numbers`);
  makePressable(plot);
  const isWhole = () => whole.x.every((end, i) => end === [plot.scales.x.min, plot.scales.x.max][i]);
  plot.hooks.draw.push(addNames(plot, chart, isWhole));
  const view = () => [plot.scales.x.min, plot.scales.x.max];
  const show = ([min, max]) => plot.setScale('x', {min, max});
  const tell = (ends) => `${chart.x.label}: ${ends.map((end) => end.toPrecision(4)).join(' to ')}`;
  const movable = {view, show, whole: whole.x, least: 1e-6, axis: chart.x, tell, say: addStatus(figure)};
  listenToKeys(figure, movable);
  listenToShift(plot, movable);
}

/** What a window becomes that grows by shares of itself at both ends: within the whole, not below the least. */
function moved([from, to], [before, after], [first, last], least) {
  const wide = Math.min(Math.max((to - from) * (1 + before + after), least * (last - first)), last - first);
  const begin = (from + to + (after - before) * (to - from) - wide) / 2;
  const within = Math.min(Math.max(begin, first), last - wide);
  return [within, within + wide];
}

/** To where an axis is even, and back. */
const evenly = (axis) => (axis.logarithmic ? [Math.log, Math.exp] : [(value) => value, (value) => value]);

// uPlot's own answer to a press is to choose a part.
const onlyWithoutShift = {mousedown: (plot, target, choose) => (event) => (event.shiftKey ? null : choose(event))};

/** With Shift the mouse takes the curves along. */
function listenToShift(plot, {view, show, whole, axis}) {
  const [there, back] = evenly(axis);
  plot.over.addEventListener('mousedown', (press) => {
    if (!press.shiftKey || press.button !== 0) return;
    press.preventDefault();
    const begun = view().map(there), perPixel = (begun[1] - begun[0]) / plot.over.clientWidth;
    const move = (event) => {
      const by = (press.clientX - event.clientX) * perPixel;
      show(moved(begun.map((end) => end + by), [0, 0], whole.map(there), 0).map(back));
    };
    document.addEventListener('mousemove', move);
    document.addEventListener('mouseup', () => document.removeEventListener('mousemove', move), {once: true});
  });
}

/**
 * + and - zoom, arrows pan, 0 shows all. `least`: the narrowest window, as a share of the whole; `tell`: its ends, in
 * words; `say`: to who cannot see it.
 */
function listenToKeys(figure, {view, show, whole, least, axis, tell, say}) {
  const [there, back] = evenly(axis);
  const steps = {'+': [-0.25, -0.25], '=': [-0.25, -0.25], '-': [0.5, 0.5],
                 'ArrowLeft': [0.2, -0.2], 'ArrowRight': [-0.2, 0.2]};
  figure.addEventListener('keydown', (event) => {
    const step = steps[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || !(step || event.key === '0')) return;
    event.preventDefault();
    const next = step && moved(view().map(there), step, whole.map(there), least).map(back);
    const isAll = !next || next[1] - next[0] >= (1 - 1e-9) * (whole[1] - whole[0]);
    show(isAll ? whole : next);
    say(isAll ? 'All is shown' : tell(next));
  });
}

/** Where a figure says what is shown to who cannot see it: takes the words. */
function addStatus(figure) {
  const told = document.createElement('p');
  told.className = 'unseen';
  told.setAttribute('role', 'status');
  told.setAttribute('aria-live', 'polite');
  figure.append(told);
  return (words) => { told.textContent = words; };
}
