// Tables of a report: sorted by the name above a column, and copied as CSV (RFC 4180) as they are sorted.

const cellsOf = (row) => [...row.cells].map((cell) => cell.textContent);

const isLimit = (text) => text.startsWith('<');

/** "2.2 m", "< 0.1", "between 10 and 11 m", "below 8 m: too few frames"; NaN of what is no number. */
const numberOf = (text) => parseFloat(text.replace(/^([<>]|between|below|above|beyond|short of)\s*/, ''));

/** Numbers by their value, and before them those of which no more is known than that they are less. */
function compare(a, b) {
  const x = numberOf(a), y = numberOf(b);
  if (Number.isNaN(x) && Number.isNaN(y)) return a.localeCompare(b);
  return isLimit(b) - isLimit(a) || x - y;
}

/** Downward too, numbers come before what is none. */
function inOrder(rows, column, descending) {
  const textOf = (row) => row.cells[column].textContent, isNone = (row) => Number.isNaN(numberOf(textOf(row)));
  const direction = descending ? -1 : 1;
  return rows.sort((a, b) => isNone(a) - isNone(b) || direction * compare(textOf(a), textOf(b)));
}

function sortBy(table, column) {
  const heads = [...table.tHead.rows[0].cells];
  const descending = heads[column].getAttribute('aria-sort') === 'ascending';
  heads.forEach((head) => head.removeAttribute('aria-sort'));
  heads[column].setAttribute('aria-sort', descending ? 'descending' : 'ascending');
  table.tBodies[0].append(...inOrder([...table.tBodies[0].rows], column, descending));
}

/** "1.0 [0.9, 1.1]" as its value and the ends of its interval, "< 0.1" as 0 and from 0 to that; else nothing. */
function estimateOf(text) {
  const [, value, low, high] = text.match(/^(\S+) \[(\S+), (\S+)\]$/) ?? [];
  if (value !== undefined) return [value, low, high];
  const [, limit] = text.match(/^< ([\d.e+-]+)$/) ?? [];
  return limit !== undefined ? ['0', '0', limit] : null;
}

/** Columns of estimates as three each, so that they are numbers. */
function asCsv(table) {
  const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const [head, ...rows] = [...table.rows].map(cellsOf);
  const isEstimate = head.map((_, column) => rows.some((row) => estimateOf(row[column]) !== null));
  const spread = (cells, parts) => cells.flatMap((cell, column) => (isEstimate[column] ? parts(cell) : [cell]));
  const lines = [spread(head, (name) => [name, `${name} low`, `${name} high`]),
                 ...rows.map((row) => spread(row, (cell) => estimateOf(cell) ?? [cell, '', '']))];
  return lines.map((line) => line.map(quoted).join(',') + '\r\n').join('');
}

/** Shows the text below a table, selected, for who must copy it by hand. */
function showSelected(below, text) {
  const area = document.createElement('textarea');
  area.className = 'csv';
  area.readOnly = true;
  area.rows = 8;
  area.value = text;
  area.setAttribute('aria-label', 'The table as CSV');
  below.after(area);
  area.select();
  return area;
}

/** By the browser's older command, which gives what is selected unless told otherwise. */
function copyBySelection(text) {
  const give = (event) => {
    event.clipboardData.setData('text/plain', text);
    event.preventDefault();
  };
  document.addEventListener('copy', give);
  try {
    return document.execCommand('copy');
  } catch {
    return false;
  } finally {
    document.removeEventListener('copy', give);
  }
}

/** Where the clipboard is refused or not there, by the older command; else people are shown the text. */
async function copyAsCsv(table, button, told) {
  const text = asCsv(table), done = `Copied, rows: ${table.tBodies[0].rows.length}`;
  told.textContent = '';
  told.parentElement.querySelector('.csv')?.remove();
  try {
    await navigator.clipboard.writeText(text);
    told.textContent = done;
  } catch {
    const area = showSelected(told, text);
    if (copyBySelection(text)) {
      area.remove();
      button.focus();
      told.textContent = done;
    } else {
      told.textContent = 'The browser lets no page copy. The text below is selected: copy it by Ctrl+C (Mac: Cmd+C).';
    }
  }
}

function addCopyButton(table, heading) {
  const line = document.createElement('div');
  const button = document.createElement('button');
  const told = document.createElement('span');  // is there before it says something, for screen readers
  line.className = 'copy';
  button.textContent = 'Copy as CSV';
  button.setAttribute('aria-label', `Copy as CSV: ${heading}`);
  told.setAttribute('role', 'status');
  told.setAttribute('aria-live', 'polite');
  button.addEventListener('click', () => copyAsCsv(table, button, told));
  line.append(button, ' ', told);
  table.parentElement.after(line);
}

const mostInALine = 22;  // characters of a column's name

/** Names as receiver.range_m may go on in the next line, on paper; longer ones on screens too. */
function breakable(name) {
  const pieces = [];
  let line = 0;
  for (const part of name.split(/(?<=[._])(?=[a-z])/)) {
    const place = document.createElement('wbr'), isNeeded = line + part.length > mostInALine;
    if (isNeeded) place.className = 'needed';
    line = (isNeeded ? 0 : line) + part.length;
    pieces.push(place, part);
  }
  return pieces.slice(1);
}

function makeLive(table) {
  const heading = table.closest('section').querySelector('h2').textContent;
  table.setAttribute('aria-label', heading);
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const button = document.createElement('button');
    button.append(...breakable(head.textContent));
    head.textContent = '';
    button.addEventListener('click', () => sortBy(table, column));
    head.append(button);
  });
  addCopyButton(table, heading);
}
