// SPDX-License-Identifier: MIT
// Filters, order and columns of the page; the part of its address after # keeps them.
'use strict';
(() => {
  const {data, rows, load} = faultlineIndex;
  const {columns, Table} = faultlineRows;
  const fields = ['text', 'verdict', 'kind', 'model'].map((id) => document.getElementById(id)).filter(Boolean);
  const count = document.getElementById('shown'), choice = document.querySelector('#choice fieldset');
  const usual = columns.filter((column) => column.usual).map((column) => column.id);
  const state = {order: 'no', columns: usual};
  const table = new Table(document.getElementById('table'), sort);
  let orderOfRows = rows, sortedBy = null, why = 'the others are being unpacked';

  function passes(row, wanted) {
    const [text, verdict, kind, model] = ['text', 'verdict', 'kind', 'model'].map((id) => wanted[id]);
    return (!verdict || row.verdict === verdict) && (!model || row.model === Number(model)) &&
      (!kind || row.faults.some((fault) => fault.kind === kind)) &&
      text.every((word) => row.words.includes(word));
  }

  function compare(a, b) {
    const without = (a === null || a === undefined) - (b === null || b === undefined);
    return without || (a < b ? -1 : a > b ? 1 : 0);
  }

  function inOrder() {
    if (sortedBy === state.order) return orderOfRows;
    const down = state.order.startsWith('-');
    const column = columns.find((c) => c.id === state.order.slice(down ? 1 : 0));
    if (column.id === 'no' && !down) return rows;
    const keyed = rows.map((row) => ({row, key: column.value(row)}));
    const missing = (key) => key === null || key === undefined;
    keyed.sort((a, b) => missing(a.key) - missing(b.key) ||
      (down ? compare(b.key, a.key) : compare(a.key, b.key)) || a.row.no - b.row.no);
    sortedBy = state.order;
    return (orderOfRows = keyed.map(({row}) => row));
  }

  function show() {
    const wanted = {model: ''};
    for (const field of fields) wanted[field.id] = field.value;
    wanted.text = wanted.text.toLowerCase().split(/\s+/).filter(Boolean);
    const all = !wanted.text.length && !wanted.verdict && !wanted.kind && !wanted.model;
    const list = all ? inOrder().slice() : inOrder().filter((row) => passes(row, wanted));
    table.show(list, state.columns, state.order);
    faultlineTrendGroup.show(all ? null : new Set(list));
    count.textContent = rows.length === data.logs ? `${list.length} of ${rows.length} logs` :
      `${list.length} of the first ${rows.length} of ${data.logs} logs; ${why}`;
  }

  function keep() {
    const parts = new URLSearchParams();
    for (const field of fields) if (field.value) parts.set(field.id, field.value);
    if (state.order !== 'no') parts.set('sort', state.order);
    if (state.columns.join() !== usual.join()) parts.set('columns', state.columns.join());
    const text = parts.toString();
    if ('#' + text !== location.hash && (text || location.hash)) history.replaceState(null, '', '#' + text);
  }

  function restore() {
    const parts = new URLSearchParams(location.hash.slice(1));
    for (const field of fields) field.value = parts.get(field.id) || '';
    for (const field of fields) if (field.selectedIndex === -1) field.value = '';
    const order = parts.get('sort') || 'no';
    state.order = columns.some((c) => c.id === order.replace(/^-/, '')) ? order : 'no';
    const wanted = (parts.get('columns') || '').split(',');
    const known = columns.map((c) => c.id).filter((id) => wanted.includes(id));
    state.columns = known.length ? known : usual;
    for (const box of choice.querySelectorAll('input')) box.checked = state.columns.includes(box.value);
    show();
  }

  function sort(id) {
    state.order = state.order === id ? '-' + id : id;
    show();
    keep();
  }

  for (const column of columns) {
    const label = document.createElement('label'), box = document.createElement('input');
    box.type = 'checkbox';
    box.value = column.id;
    label.append(box, ' ' + column.title);
    choice.append(label);
    box.addEventListener('change', () => {
      const on = Array.from(choice.querySelectorAll('input:checked'), (one) => one.value);
      if (!on.length) return void (box.checked = true);
      state.columns = on;
      show();
      keep();
    });
  }
  function startTrends() {
    // The row of a log that the filters hide is not in the plots either.
    faultlineTrendGroup.start((row) => table.goTo(row));
    sortedBy = null;
    show();
  }

  async function loadOthers() {
    try {
      await load();
      why = 'the others are missing in this file: copy it again';
    } catch (error) {
      why = `the others cannot be unpacked (${error.message}): the file was cut off, or the browser is from before ` +
        '2023; index.csv lists all';
    }
    startTrends();
  }

  for (const field of fields) field.addEventListener('input', () => { show(); keep(); });
  addEventListener('hashchange', restore);
  document.documentElement.classList.add('js');
  restore();
  // For those who measure: when the first rows are on the screen, and when all are there.
  requestAnimationFrame(() => requestAnimationFrame(() => performance.mark('first rows')));
  faultlineIndex.whole = rows.length < data.logs ? loadOthers() : startTrends();
})();
