// SPDX-License-Identifier: MIT
// Sorts and filters the table of logs. Without it the table stands as it is.
'use strict';
(() => {
  const table = document.getElementById('logs'), body = table.tBodies[0];
  const rows = Array.from(body.rows), shown = document.getElementById('shown');
  const text = document.getElementById('text'), verdict = document.getElementById('verdict');
  const kind = document.getElementById('kind');
  const words = rows.map(row => row.textContent.toLowerCase());

  function filter() {
    const wanted = text.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    rows.forEach((row, i) => {
      const show = (!verdict.value || row.dataset.v === verdict.value) &&
        (!kind.value || row.dataset.k.split(' ').includes(kind.value)) &&
        wanted.every(word => words[i].includes(word));
      row.hidden = !show;
      count += show;
    });
    shown.textContent = `${count} of ${rows.length} logs`;
  }

  function value(row, column) {
    const cell = row.cells[column], given = cell.dataset.s;
    return given === undefined ? cell.textContent : given === '' ? NaN : Number(given);
  }

  function compare(a, b) {
    if (typeof a === 'string') return a < b ? -1 : a > b ? 1 : 0;
    if (isNaN(a) || isNaN(b)) return isNaN(a) - isNaN(b);
    return a - b;
  }

  function sort(column, head) {
    const down = head.getAttribute('aria-sort') === 'ascending';
    for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const keyed = rows.map((row, place) => ({row, place, key: value(row, column)}));
    keyed.sort((a, b) => {
      const missing = typeof a.key === 'number' && isNaN(a.key) - isNaN(b.key);
      return missing || (down ? compare(b.key, a.key) : compare(a.key, b.key)) || a.place - b.place;
    });
    const all = document.createDocumentFragment();
    for (const {row} of keyed) all.append(row);
    body.append(all);
  }

  Array.from(table.tHead.rows[0].cells).forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = head.textContent;
    button.addEventListener('click', () => sort(column, head));
    head.replaceChildren(button);
  });
  for (const field of [text, verdict, kind]) field.addEventListener('input', filter);
  document.documentElement.classList.add('js');
  filter();
})();
