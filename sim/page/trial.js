// A trial with every tap of the receiver: plots below each other that show the same time.

const tapHeight = 130;
const mostColumns = 1500;
const fewestSamples = 8;  // of the narrowest window
const tapColours = {  // those of the still figure
  irradiance_mw_per_m2: '#d55e00', band_pass_mw_per_m2: '#009e73', threshold_mw_per_m2: '#e69f00',
  integrator_samples: '#cc79a7', agc_gain: '#56b4e9'};
const pinColour = '#0072b2';
const markSizes = [13, 11, 9];  // pixels

/** Values of 16 bits, least byte first. */
function unpacked(text) {
  const bytes = atob(text);
  const steps = new Uint16Array(bytes.length / 2);
  for (let i = 0; i < steps.length; ++i) steps[i] = bytes.charCodeAt(2 * i) + 256 * bytes.charCodeAt(2 * i + 1);
  return steps;
}

const samplePeriod = (trial) => (trial.stretch > 1 ? 2 * trial.period_s / trial.stretch : trial.period_s);

/** Two grids of a trial's samples: all of it, and where these are stretches every sample about a byte. */
function gridsOf(trial) {
  const {first_s, period_s, stretch, detail_first_s} = trial;
  const whole = {first_s, period_s, stretch};
  return stretch > 1 ? [whole, {first_s: detail_first_s, period_s: samplePeriod(trial), stretch: 1}] : [whole];
}

/** Its name, unit and range, and its values on each grid, as steps of that range. */
function tapOf(tap) {
  const values = [tap.values, tap.detail].map(unpacked);
  const scale = (tap.greatest - tap.least) / 65535;
  return {...tap, values, of: (step) => tap.least + step * scale};
}

const reachesOver = (grid, count, [from, to]) => grid.first_s <= from && to <= grid.first_s + count * grid.period_s;

/** The values of a tap that lie in a window, on the finer grid where that reaches over it, and in what steps to go. */
function partOf(grids, tap, view) {
  const fine = grids.length > 1 && reachesOver(grids[1], tap.values[1].length, view) ? 1 : 0;
  const {first_s, period_s, stretch} = grids[fine], values = tap.values[fine];
  const index = (time) => (time - first_s) / period_s;
  const count = Math.ceil(index(view[1])) + 2 - Math.floor(index(view[0]));
  const isRoomy = count <= 2 * mostColumns;
  const step = isRoomy ? Math.min(stretch, 2) : 2 * Math.ceil(count / mostColumns / 2);
  const first = Math.max(0, step * Math.floor((index(view[0]) - 1) / step));
  const last = Math.min(values.length, Math.ceil(index(view[1])) + 2);
  return {values, step, first, last, isBoxes: isRoomy && step > 1, time: (i) => first_s + i * period_s};
}

/** Calls back with the ends in time of each step, and its least and greatest. */
function forEachStep(tap, {values, step, first, last, time}, visit) {
  for (let i = first; i < last; i += step) {
    let least = 65535, greatest = 0;
    for (let j = i; j < Math.min(i + step, last); ++j) {
      if (values[j] < least) least = values[j];
      if (values[j] > greatest) greatest = values[j];
    }
    visit(time(i - 0.5), time(i + step - 0.5), tap.of(least), tap.of(greatest));
  }
}

/** The curve of a tap in a window: of many values the least and greatest of each column; none where there are boxes. */
function seen(grids, tap, view) {
  const part = partOf(grids, tap, view);
  if (part.isBoxes) return [view, [null, null]];
  const x = [], y = [];
  forEachStep(tap, part, (from, to, least, greatest) => {
    x.push((from + to) / 2);
    y.push(least);
    if (part.step === 1) return;
    x.push(to);
    y.push(greatest);
  });
  return [x, y];
}

/** Stretches of which no more is known than the least and the greatest, where there is room for them. */
function drawBoxes(plot, grids, taps) {
  const {ctx, bbox, scales} = plot;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  taps.forEach((tap, k) => {
    const part = partOf(grids, tap, [scales.x.min, scales.x.max]);
    if (!part.isBoxes) return;
    const at = (value, axis) => plot.valToPos(value, axis, true);
    ctx.fillStyle = ctx.strokeStyle = plot.series[k + 1].stroke();
    ctx.beginPath();
    forEachStep(tap, part, (from, to, least, greatest) => (
      ctx.rect(at(from, 'x'), at(greatest, 'y'), at(to, 'x') - at(from, 'x'), at(least, 'y') - at(greatest, 'y'))));
    ctx.stroke();
    ctx.globalAlpha = 0.3;
    ctx.fill();
    ctx.globalAlpha = 1;
  });
  ctx.restore();
}

/** The pin as steps. */
function seenWire(trial, [from, to]) {
  let level = trial.wire_begins ? 1 : 0;
  const x = [from], y = [];
  const inside = [];
  for (const edge of trial.wire_edges_s) {
    if (edge > from && edge < to) inside.push(edge);
    if (edge <= from) level = 1 - level;
  }
  y.push(level);
  for (const edge of inside) {
    x.push(edge, edge);
    y.push(level, 1 - level);
    level = 1 - level;
  }
  x.push(to);
  y.push(level);
  return [x, y];
}

/** Marks that stand clear of each other in the plot's font. Misread ones come first, in brackets. */
function withRoom(plot, marks) {
  const kept = [];
  for (const [seconds, mark, isWrong] of [...marks].sort((a, b) => b[2] - a[2])) {
    const text = isWrong ? `[${mark}]` : mark, at = plot.valToPos(seconds, 'x', true);
    const half = plot.ctx.measureText(text).width / 2 + pixelRatio();
    if (kept.every((other) => Math.abs(other.at - at) >= other.half + half)) kept.push({text, at, half, isWrong});
  }
  return kept;
}

/** All marks as large as they have room; in the smallest type those that have. Leaves the plot's font so. */
function placed(plot, marks) {
  let kept = [];
  for (const size of markSizes) {
    plot.ctx.font = `${size * pixelRatio()}px monospace`;
    kept = withRoom(plot, marks);
    if (kept.length === marks.length) break;
  }
  return kept;
}

/** Characters, or where there is room bits, along the top of a plot. */
function drawMarks(plot, marks, bits) {
  const {left, top, width} = plot.bbox;
  const ratio = pixelRatio();
  const {min, max} = plot.scales.x;
  const shown = (list) => list.filter(([at]) => at >= min && at <= max);
  const fits = bits.length > 0 && shown(bits).length * 14 * ratio < width;
  const list = fits ? shown(bits) : shown(marks);
  const ink = styled('--ink'), wrong = styled('--wrong');
  plot.ctx.save();
  plot.ctx.textAlign = 'center';
  for (const {text, at, isWrong} of placed(plot, list)) {
    plot.ctx.fillStyle = isWrong ? wrong : ink;
    plot.ctx.fillText(text, at, top - 5 * ratio);
  }
  plot.ctx.restore();
}

function rangeOf(taps) {
  const least = Math.min(...taps.map((tap) => tap.least)), greatest = Math.max(...taps.map((tap) => tap.greatest));
  const margin = 0.05 * (greatest - least || 1);
  return [least - margin, greatest + margin];
}

/** The bits of the message: the pin's, but where these are wrong. */
const sentBits = (trial) => trial.bits.map(([at, level, isWrong]) => [at, isWrong ? String(1 - level) : level, false]);

/** Where the pin has them. */
const readBits = (trial) => trial.bits.map(([at, ...rest]) => [at + trial.delay_s, ...rest]);

/** Plots below each other: the light, band-pass and threshold, the others by themselves, the pin. */
function rowsOf(trial) {
  const grids = gridsOf(trial), taps = trial.taps.map(tapOf);
  const row = (members) => ({
    title: members.map((tap, k) => `${k > 0 ? 'thick: ' : ''}${tap.name}${tap.unit && ` [${tap.unit}]`}`).join('; '),
    range: rangeOf(members),
    colours: members.map((tap) => tapColours[tap.key]),
    see: (view) => {
      const [[x, first], ...others] = members.map((tap) => seen(grids, tap, view));
      return [x, first, ...others.map((other) => other[1])];
    },
    draw: (plot) => drawBoxes(plot, grids, members),
    marks: [], bits: []});
  const of = (...names) => taps.filter((tap) => names.includes(tap.key));
  const rows = [of('irradiance_mw_per_m2'), of('band_pass_mw_per_m2', 'threshold_mw_per_m2'),
                of('integrator_samples'), of('agc_gain')].filter((members) => members.length > 0).map(row);
  rows[0].marks = trial.sent;
  rows[0].bits = sentBits(trial);
  rows.push({title: "receiver's pin, 0 is light", range: [-0.1, 1.1], levels: [0, 1], colours: [pinColour],
             see: (view) => seenWire(trial, view), draw: () => {}, marks: trial.read, bits: readBits(trial)});
  return rows;
}

/** A window of seconds, to hundredths of its width. */
function tellMilliseconds([from, to]) {
  const decimals = Math.max(0, Math.ceil(2 - Math.log10((to - from) * 1e3)));
  return `ms: ${[from, to].map((end) => (end * 1e3).toFixed(decimals)).join(' to ')}`;
}

function drawTrial(figure, trial, number) {
  const whole = [-0.005, trial.message_s + 0.02];
  const least = fewestSamples * samplePeriod(trial) / (whole[1] - whole[0]);
  const rows = rowsOf(trial), plots = [];
  let asked = whole, shown = whole;
  const show = (view) => {
    asked = view;
    shown = moved(view, [0, 0], whole, least);
    plots.forEach((plot, i) => {
      plot.setData(rows[i].see(shown), false);
      plot.setScale('x', {min: shown[0], max: shown[1]});
    });
  };
  const isAt = (plot, [from, to]) => plot.scales.x.min === from && plot.scales.x.max === to;
  const catchUp = (plot) => {
    if (!isAt(plot, shown) && !isAt(plot, asked)) show([plot.scales.x.min, plot.scales.x.max]);
  };
  // A plot takes new data only when it has done with the scale that it tells of.
  const follow = (plot, key) => {
    if (key === 'x' && plots.length === rows.length) queueMicrotask(() => catchUp(plot));
  };
  rows.forEach((row, i) => {
    plots.push(plotOf(figure, row, `trial ${number}`, whole, follow));
    keepUp(figure, plots[i], tapHeight, `${row.title} over time`);
  });
  plots.forEach((plot) => plot.over.addEventListener('dblclick', () => show(whole)));
  const say = addStatus(figure);
  const movable = {view: () => shown, show, whole, least, axis: {}, tell: tellMilliseconds, say};
  listenToKeys(figure, movable);
  plots.forEach((plot) => listenToShift(plot, movable));
  const byte = [trial.byte_from_s - trial.byte_s / 10, trial.byte_from_s + 1.1 * trial.byte_s];
  const edge = [trial.edge_from_s, trial.edge_to_s];
  const showAndSay = (view) => {
    show(view);
    say(tellMilliseconds(shown));
  };
  addViews(figure, showAndSay, {'The whole frame': whole, 'A byte': byte, 'Cycles at an edge': edge});
  if (trial.stretch > 1) sayWhatIsKept(figure, trial);
}

/** Plots of one `sync` are dragged over together. */
function plotOf(figure, row, sync, whole, follow) {
  return new uPlot({
    title: row.title,
    width: figure.clientWidth,
    height: tapHeight,
    legend: {show: false},
    cursor: {bind: onlyWithoutShift, sync: {key: sync}, drag: {x: true, y: false}, points: {show: false}},
    scales: {x: {time: false, range: (u, from, to) => [from, to]}, y: {range: row.range}},
    axes: [{...axisOf({}), size: 34, space: 90,
            values: (u, seconds) => labelsOf(seconds.map((value) => value * 1e3))},
           {...axisOf({}), size: 70, space: 18, ...(row.levels && {splits: () => row.levels})}],
    padding: [row.marks.length > 0 ? 16 : 4, 8, 0, 0],
    series: [{}, ...row.colours.map((colour, k) => (
      {stroke: () => shadeOf(colour), width: k > 0 ? 2 : 1, points: {show: false}}))],
    hooks: {setScale: [follow], draw: [row.draw, (u) => drawMarks(u, row.marks, row.bits)]},
  }, row.see(whole), figure);
}

function sayWhatIsKept(figure, trial) {
  const count = unpacked(trial.taps[0].detail).length;
  const ends = [trial.detail_first_s, trial.detail_first_s + count * samplePeriod(trial)];
  const note = document.createElement('p');
  note.className = 'hint';
  note.textContent = `From ${ends.map((end) => (end * 1e3).toFixed(3)).join(' to ')} ms every sample is kept; ` +
    `elsewhere the least and the greatest of each ${trial.stretch} samples, which are seen as boxes where there is room.`;
  figure.before(note);
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
