// Brings a report to life: its tables, and where uPlot is there its charts and trials. Without scripts
// the still pictures and the tables stay.

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
