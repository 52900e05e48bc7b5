// Axes of a report's live plots: how far they reach, and what stands at their marks.

const arrow = 24;  // pixels of a limit's arrow
const axisWidth = 50, aboutLabels = 25;  // pixels: the narrowest of what stands upright, and all but its labels

const isShown = (axis, value) => Number.isFinite(value) && (!axis.logarithmic || value > 0);

/** The ends of an interval, but of one that goes far down, as where next to nothing was found, not the lower. */
const endsOf = (point, axis) => [point.high, axis.logarithmic && !(point.low >= point.y / 10) ? NaN : point.low];

/** So that a level's line is not on the edge. */
const aboutLevel = ({level}) => (level ? [level.at / 2, level.at * 2] : []);

/** The exponent `from`, or one so far below it that the lowest limit stands `share` of the axis above its foot. */
function below(from, to, limits, share) {
  const lowest = Math.min(...limits.map(Math.log10));
  return lowest - from < share * (to - from) ? below(from - 1, to, limits, share) : from;
}

/** The least exponent of 1, 2 or 5 times a power of ten that is no less. */
function roundAbove(exponent) {
  const slack = 1e-9, decade = Math.floor(exponent + slack);
  return decade + ([0, Math.log10(2), Math.log10(5)].find((part) => decade + part >= exponent - slack) ?? 1);
}

/** The decades of a logarithmic axis that values need, as much more as intervals do, and room below `limits`. */
function decades(values, ends, limits, share) {
  const least = (all) => Math.log10(Math.min(...all)), greatest = (all) => Math.log10(Math.max(...all));
  const top = Math.ceil(greatest(values) - 1e-9), foot = Math.min(Math.floor(least(values) + 1e-9), top - 1);
  const to = Math.max(top, roundAbove(greatest([...values, ...ends])));
  const from = Math.min(foot, -roundAbove(-least([...values, ...ends])));
  return [10 ** below(from, to, limits, share), 10 ** to];
}

/** What an axis covers: values, the `ends` of their intervals, and below `limits` a share of it. */
function reach(axis, values, ends = [], limits = [], share = 0) {
  const [shown, shownEnds] = [values, ends].map((all) => all.filter((value) => isShown(axis, value)));
  if (shown.length === 0) return axis.logarithmic ? [0.1, 1] : [0, 1];
  if (axis.logarithmic) return decades(shown, shownEnds, limits, share);
  return spanOf([...shown, ...shownEnds], false);
}

/** From the least to the greatest; a little about a single value. */
function spanOf(values, logarithmic) {
  const least = Math.min(...values), greatest = Math.max(...values);
  if (least < greatest) return [least, greatest];
  return logarithmic ? [least / 2, greatest * 2] : [least - 0.5, greatest + 0.5];
}

/** What a lower axis covers: from its first value to its last, not whole decades. */
function reachAcross(axis, values) {
  const shown = values.filter((value) => isShown(axis, value));
  return padded(shown.length > 0 ? spanOf(shown, axis.logarithmic) : [0.1, 1], axis);
}

/** A little beyond the first and the last, so that their marks are seen whole. */
function padded([from, to], axis) {
  const margin = 0.02;
  if (axis.logarithmic) return [from * (to / from) ** -margin, to * (to / from) ** margin];
  return [from - margin * (to - from), to + margin * (to - from)];
}

/** Of 1, 2 and 5 times a power of ten alone; others get in each other's way. */
function logarithmicLabel(value) {
  if (value === null) return '';
  const [digit, exponent] = value.toExponential(6).replace(/\.?0+e/, 'e').split('e');
  if (!['1', '2', '5'].includes(digit)) return '';
  if (exponent >= -2 && exponent <= 4) return String(Number(value.toPrecision(6)));
  return digit === '1' ? `1e${Number(exponent)}` : '';
}

/** With the decimals that tell the marks apart. */
function labelsOf(marks) {
  const step = marks.length > 1 ? marks[1] - marks[0] : Math.abs(marks[0]);
  const isTrue = (decimals) => marks.every((mark) => Math.abs(Number(mark.toFixed(decimals)) - mark) <= 1e-3 * step);
  let decimals = 0;
  while (decimals < 12 && !isTrue(decimals)) ++decimals;
  return marks.map((mark) => mark.toFixed(decimals));
}

const pixelRatio = () => window.devicePixelRatio || 1;

/** So that the axis' title does not touch its labels. */
function widthFor(plot, labels, i) {
  plot.ctx.font = plot.axes[i].font[0];
  const widths = (labels || []).map((label) => plot.ctx.measureText(label).width / pixelRatio());
  return Math.max(axisWidth, aboutLabels + Math.max(0, ...widths));
}

/** Colours of the style sheet, which are others in the dark. */
const styled = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

const wholeSteps = Array.from({length: 12}, (_, i) => [1, 2, 5].map((digit) => digit * 10 ** i)).flat();

/** Of counts there are no marks between whole numbers. */
const marksFor = (axis) => (axis.is_count ? {incrs: wholeSteps} : {});

/** 1 to 9 of each decade. */
function digitsWithin(least, greatest) {
  const first = Math.floor(Math.log10(least)), decades = Math.ceil(Math.log10(greatest)) - first;
  return Array.from({length: 9 * decades}, (_, i) => Number(`${i % 9 + 1}e${first + Math.floor(i / 9)}`))
    .concat(Number(`1e${first + decades}`)).filter((mark) => mark >= least && mark <= greatest);
}

/** Steps of 1, 2 or 5 times a power of ten. */
function stepsWithin(least, greatest) {
  const most = 8, power = 10 ** Math.floor(Math.log10((greatest - least) / most));
  const step = power * [1, 2, 5, 10].find((digit) => (greatest - least) / (digit * power) <= most);
  const first = Math.ceil(least / step);
  return Array.from({length: Math.floor(greatest / step) - first + 1}, (_, i) => (first + i) * step);
}

/** On a lower logarithmic axis: 1, 2 and 5 of each decade where they have room, else powers of ten; of less even steps. */
function lowerMarks(axis) {
  if (!axis.logarithmic) return {};
  const leastGap = 36;  // pixels
  const isWide = ({scales: {x}}) => x.max / x.min >= 10;
  const hasRoom = (plot) => plot.valToPos(10, 'x') - plot.valToPos(5, 'x') >= leastGap;
  const isPower = (value) => Number.isInteger(Math.round(1e6 * Math.log10(value)) / 1e6);
  return {
    splits: (plot, i, ...ends) => (isWide(plot) ? digitsWithin : stepsWithin)(...ends),
    filter: (plot, marks) => marks.map((mark) => (!isWide(plot) || hasRoom(plot) || isPower(mark) ? mark : null)),
    values: (plot, marks) => (isWide(plot) ? marks.map(logarithmicLabel) : labelsOf(marks)),
  };
}

function axisOf(axis) {
  const faint = {stroke: 'rgba(128, 128, 128, 0.25)', width: 1};
  return {label: axis.title, stroke: () => styled('--ink'), grid: faint, ticks: faint,
          values: (plot, marks) => (axis.logarithmic ? marks.map(logarithmicLabel) : labelsOf(marks))};
}
