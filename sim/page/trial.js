// A trial with every tap of the receiver: plots below each other that show the same time.

const tapHeight = 130;
const mostColumns = 1500;

/** 16-bit steps of a tap's range, as it was packed. */
function unpacked(tap) {
  const bytes = Uint8Array.from(atob(tap.values), (c) => c.charCodeAt(0));
  const steps = new DataView(bytes.buffer);
  const scale = (tap.greatest - tap.least) / 65535;
  return Float32Array.from({length: bytes.length / 2},
                           (_, i) => tap.least + steps.getUint16(2 * i, true) * scale);
}

/** What of a tap is seen in a window; of many values the least and greatest of each column. */
function seen(trial, values, [from, to]) {
  const index = (time) => (time - trial.first_s) / trial.period_s;
  const first = Math.max(0, Math.floor(index(from)) - 1);
  const last = Math.min(values.length, Math.ceil(index(to)) + 2);
  const time = (i) => trial.first_s + i * trial.period_s;
  const x = [], y = [];
  const step = Math.max(1, Math.floor((last - first) / mostColumns));
  for (let i = first; i < last; i += step) {
    if (step === 1) {
      x.push(time(i));
      y.push(values[i]);
      continue;
    }
    let least = Infinity, greatest = -Infinity;
    for (let j = i; j < Math.min(i + step, last); ++j) {
      if (values[j] < least) least = values[j];
      if (values[j] > greatest) greatest = values[j];
    }
    x.push(time(i), time(i + step / 2));
    y.push(least, greatest);
  }
  return [x, y];
}

/** The pin as steps. */
function seenWire(trial, [from, to]) {
  let level = trial.wire_begins ? 1 : 0;
  const x = [from], y = [];
  const inside = [];
  for (const flip of trial.wire_flips_s) {
    if (flip > from && flip < to) inside.push(flip);
    if (flip <= from) level = 1 - level;
  }
  y.push(level);
  for (const flip of inside) {
    x.push(flip, flip);
    y.push(level, 1 - level);
    level = 1 - level;
  }
  x.push(to);
  y.push(level);
  return [x, y];
}

/** Characters, or where there is room bits, along the top of a plot. */
function drawMarks(plot, marks, bits) {
  const {left, top, width} = plot.bbox;
  const ratio = window.devicePixelRatio || 1;
  const {min, max} = plot.scales.x;
  const shown = (list) => list.filter(([at]) => at >= min && at <= max);
  const fits = bits.length > 0 && shown(bits).length * 14 * ratio < width;
  const list = fits ? shown(bits) : shown(marks);
  if (list.length * 10 * ratio > width) return;
  plot.ctx.save();
  plot.ctx.font = `${13 * ratio}px monospace`;
  plot.ctx.textAlign = 'center';
  for (const [at, text, isWrong] of list) {
    plot.ctx.fillStyle = isWrong ? '#d03010' : getComputedStyle(document.documentElement).getPropertyValue('--ink');
    plot.ctx.fillText(isWrong ? `[${text}]` : text, plot.valToPos(at, 'x', true), top - 5 * ratio, width);
  }
  plot.ctx.restore();
}

function spanOf(taps) {
  const least = Math.min(...taps.map((tap) => tap.least)), greatest = Math.max(...taps.map((tap) => tap.greatest));
  const margin = 0.05 * (greatest - least || 1);
  return [least - margin, greatest + margin];
}

/** Milliseconds with the decimals that tell the marks apart. */
function millisecondLabels(plot, seconds) {
  const step = (seconds[1] - seconds[0]) * 1e3;
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9) + (step < 1 ? 1 : 0));
  return seconds.map((value) => (value * 1e3).toFixed(Math.min(decimals, 6)));
}

/** Plots below each other: the light, band-pass and threshold, the others by themselves, the pin. */
function rowsOf(trial) {
  const taps = trial.taps.map((tap) => ({...tap, data: unpacked(tap)}));
  const row = (members) => ({
    title: members.map((tap) => `${tap.name} [${tap.unit}]`).join('; '),
    range: spanOf(members),
    see: (view) => {
      const [[x, first], ...others] = members.map((tap) => seen(trial, tap.data, view));
      return [x, first, ...others.map((other) => other[1])];
    },
    marks: [], bits: []});
  const of = (...names) => taps.filter((tap) => names.includes(tap.key));
  const rows = [of('irradiance_mw_per_m2'), of('band_pass_mw_per_m2', 'threshold_mw_per_m2'),
                of('integrator_samples'), of('agc_gain')].filter((members) => members.length > 0).map(row);
  rows[0].marks = trial.sent;
  rows.push({title: "receiver's pin, 0 is light", range: [-0.1, 1.1], see: (view) => seenWire(trial, view),
             marks: trial.read, bits: trial.bits});
  return rows;
}

function drawTrial(figure, trial) {
  const whole = [-0.005, trial.message_s + 0.02];
  const rows = rowsOf(trial);
  let busy = false;
  const show = (view) => {
    busy = true;
    plots.forEach((plot, i) => {
      plot.setData(rows[i].see(view), false);
      plot.setScale('x', {min: view[0], max: view[1]});
    });
    busy = false;
  };
  const moved = (plot, key) => {
    if (key === 'x' && !busy && plots.length === rows.length) show([plot.scales.x.min, plot.scales.x.max]);
  };
  const plots = [];
  rows.forEach((row, i) => plots.push(new uPlot({
    title: row.title,
    width: figure.clientWidth,
    height: tapHeight,
    legend: {show: false},
    cursor: {sync: {key: 'trial'}, drag: {x: true, y: false}, points: {show: false}},
    scales: {x: {time: false, range: (u, from, to) => [from, to]}, y: {range: row.range}},
    axes: [{...axisOf({}), size: 34, values: millisecondLabels},
           {...axisOf({}), size: 70, space: 18}],
    padding: [row.marks.length > 0 ? 16 : 4, 8, 0, 0],
    series: [{}, ...row.see(whole).slice(1).map((values, k) => (
      {stroke: colours[(i + 5 * k) % colours.length], width: k > 0 ? 2 : 1, points: {show: false}}))],
    hooks: {setScale: [moved], draw: [(u) => drawMarks(u, row.marks, row.bits)]},
  }, row.see(whole), figure)));
  show(whole);
  plots.forEach((plot) => plot.over.addEventListener('dblclick', () => show(whole)));
  listenToKeys(figure, {scales: plots[0].scales, setScale: (key, {min, max}) => show([min, max])}, {}, whole);
  window.addEventListener('resize', () => plots.forEach((plot) => plot.setSize({width: figure.clientWidth, height: tapHeight})));
  const byte = [trial.byte_from_s - trial.byte_s / 10, trial.byte_from_s + 1.1 * trial.byte_s];
  const edge = [trial.byte_from_s - 5 * trial.cycle_s, trial.byte_from_s + 25 * trial.cycle_s];
  addViews(figure, show, {'The whole frame': whole, 'A byte': byte, 'Cycles at an edge': edge});
}

function addViews(figure, show, views) {
  const buttons = document.createElement('p');
  for (const [name, view] of Object.entries(views)) {
    const button = document.createElement('button');
    button.textContent = name;
    button.addEventListener('click', () => show(view));
    buttons.append(button, ' ');
  }
  buttons.className = 'views';
  figure.before(buttons);
}
