// Live charts and tables of a report. Without this script the still pictures and the tables stay.
'use strict';

(() => {
  const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
  const dashes = [undefined, [2, 3], [10, 3, 2, 3]];  // where there are more curves than colours
  const height = 420;
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
      context.strokeStyle = colours[i % colours.length];
      context.lineWidth = ratio;
      context.setLineDash([]);
      context.beginPath();
      for (const point of row) {
        if (!point || !(point.high > 0)) continue;
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
    return chart.curves.map((curve, i) => ({
      label: curve.name,
      stroke: colours[i % colours.length],
      dash: curve.kind === 'theory' ? [6, 4] : dashes[Math.floor(i / colours.length) % dashes.length],
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

  function axisOf(axis) {
    const ink = getComputedStyle(document.documentElement).getPropertyValue('--ink');
    const faint = {stroke: 'rgba(128, 128, 128, 0.25)', width: 1};
    const common = {label: axis.label, stroke: ink, grid: faint, ticks: faint};
    return axis.logarithmic ? {...common, values: (plot, marks) => marks.map(logarithmicLabel)} : common;
  }

  function drawLive(figure, chart) {
    const {x, rows} = alignedPoints(chart);
    const values = rows.flat().filter((point) => point).flatMap((point) => [point.y, point.low, point.high]);
    const whole = {x: padded(reach({}, x), chart.x), y: reach(chart.y, values)};
    const scale = (axis, range) => ({time: false, distr: axis.logarithmic ? 3 : 1, range});
    const plot = new uPlot({
      width: figure.clientWidth,
      height,
      scales: {
        x: scale(chart.x, (u, from, to) => (from === x[0] && to === x.at(-1) ? whole.x : [from, to])),
        y: scale(chart.y, () => whole.y),
      },
      axes: [axisOf(chart.x), axisOf(chart.y)],
      series: [{label: chart.x.label}, ...seriesOf(chart)],
      hooks: {draw: [(u) => drawIntervals(u, chart, rows)]},
    }, [x, ...rows.map((row) => row.map((point) => (point && !point.is_limit ? point.y : null)))], figure);
    listenToKeys(figure, plot, chart.x, whole.x);
    window.addEventListener('resize', () => plot.setSize({width: figure.clientWidth, height}));
    return plot;
  }

  /** + and - zoom, arrows pan, 0 shows all. */
  function listenToKeys(figure, plot, axis, whole) {
    const there = axis.logarithmic ? Math.log : (value) => value;
    const back = axis.logarithmic ? Math.exp : (value) => value;
    const steps = {'+': [0.25, -0.25], '=': [0.25, -0.25], '-': [-0.5, 0.5],
                   'ArrowLeft': [-0.2, -0.2], 'ArrowRight': [0.2, 0.2]};
    figure.addEventListener('keydown', (event) => {
      if (event.key === '0') plot.setScale('x', {min: whole[0], max: whole[1]});
      const step = steps[event.key];
      if (!step) return;
      event.preventDefault();
      const from = there(plot.scales.x.min), to = there(plot.scales.x.max);
      plot.setScale('x', {min: back(from + step[0] * (to - from)), max: back(to + step[1] * (to - from))});
    });
  }

  // ---- a trial with every tap

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

  // ---- tables

  const cellsOf = (row) => [...row.cells].map((cell) => cell.textContent);

  /** Numbers before texts, by their value; texts by their letters. */
  function compare(a, b) {
    const x = parseFloat(a.replace(/^[<>]\s*/, '')), y = parseFloat(b.replace(/^[<>]\s*/, ''));
    if (Number.isNaN(x) && Number.isNaN(y)) return a.localeCompare(b);
    if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
    return x - y;
  }

  function sortBy(table, column) {
    const heads = [...table.tHead.rows[0].cells];
    const descending = heads[column].getAttribute('aria-sort') === 'ascending';
    heads.forEach((head) => head.removeAttribute('aria-sort'));
    heads[column].setAttribute('aria-sort', descending ? 'descending' : 'ascending');
    const rows = [...table.tBodies[0].rows];
    rows.sort((a, b) => compare(a.cells[column].textContent, b.cells[column].textContent));
    if (descending) rows.reverse();
    table.tBodies[0].append(...rows);
  }

  function asCsv(table) {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    return [...table.rows].map((row) => cellsOf(row).map(quoted).join(',')).join('\n') + '\n';
  }

  function makeSortable(table) {
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      const button = document.createElement('button');
      button.append(...head.childNodes);
      button.addEventListener('click', () => sortBy(table, column));
      head.append(button);
    });
    const copy = document.createElement('button');
    copy.className = 'copy';
    copy.textContent = 'Copy as CSV';
    copy.addEventListener('click', async () => {
      await navigator.clipboard.writeText(asCsv(table));
      copy.textContent = 'Copied';
    });
    table.parentElement.after(copy);
  }

  document.querySelectorAll('table').forEach(makeSortable);
  if (typeof uPlot !== 'undefined') {
    const hint = document.createElement('p');
    hint.className = 'hint';
    hint.textContent = 'Charts: drag to zoom, double-click for all; by keyboard + and -, arrows, 0 for all.';
    document.querySelector('.verdict').after(hint);
    const charts = JSON.parse(document.getElementById('charts').textContent);
    document.querySelectorAll('.chart').forEach((figure, i) => {
      figure.classList.add('live');
      figure.tabIndex = 0;
      drawLive(figure, charts[i]);
    });
    const trials = JSON.parse(document.getElementById('trials').textContent);
    document.querySelectorAll('.trial').forEach((figure, i) => {
      figure.classList.add('live');
      figure.tabIndex = 0;
      drawTrial(figure, trials[i]);
    });
  }
})();
