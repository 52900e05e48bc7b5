// Tables of a report: sorted by the name above a column, and copied as CSV.

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
