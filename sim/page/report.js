// Brings a report to life: its tables, and where uPlot is there its charts and trials. Without scripts
// the still pictures and the tables stay.

/** Can be reached by the keyboard, and said by screen readers how to be used. */
function makeReachable(figure) {
  figure.classList.add('live');
  figure.tabIndex = 0;
  figure.setAttribute('aria-describedby', 'keys');
}

function addHint() {
  const hint = document.createElement('p');
  hint.className = 'hint';
  hint.id = 'keys';
  hint.textContent = 'Charts: drag to zoom, Shift and drag to move, double-click for all; by keyboard + and -, arrows, 0 for all.';
  document.querySelector('nav').before(hint);
}

/** What is wider than the window is scrolled by the keyboard too. */
function makeScrollable(box) {
  const isWide = box.scrollWidth > box.clientWidth;
  const heading = box.closest('section').querySelector('h2').textContent;
  for (const [name, value] of Object.entries({tabindex: '0', role: 'region', 'aria-label': `${heading}, to scroll`}))
    isWide ? box.setAttribute(name, value) : box.removeAttribute(name);
}

function watchWidths() {
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => makeScrollable(entry.target)));
  document.querySelectorAll('.table, .still, pre').forEach((box) => watch.observe(box));
}

/** Where drawing fails the still picture comes back. */
function drawOne(figure, draw) {
  makeReachable(figure);
  try {
    draw();
  } catch (error) {
    figure.classList.remove('live');
    [...figure.children].forEach((child) => child.classList.contains('still') || child.remove());
    console.error(error);
  }
}

function drawEach(kind, draw) {
  const data = JSON.parse(document.getElementById(`${kind}s`).textContent);
  document.querySelectorAll(`.${kind}`).forEach((figure, i) => drawOne(figure, () => draw(figure, data[i], i)));
}

/** On paper the text that ran is whole. */
function openScenarios() {
  document.querySelectorAll('section:has(pre) details').forEach((details) => { details.open = true; });
}

document.querySelectorAll('table').forEach(makeLive);
window.addEventListener('beforeprint', openScenarios);
watchWidths();
if (typeof uPlot !== 'undefined') {
  addHint();
  drawEach('chart', drawLive);
  drawEach('trial', drawTrial);
}
