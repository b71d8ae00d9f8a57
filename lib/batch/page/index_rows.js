// SPDX-License-Identifier: MIT
// The table of logs. Rows stand in blocks, each a <tbody>; a block out of sight is one empty row of its height,
// so that ten thousand logs cost no more than a screen of them.
'use strict';
const faultlineRows = (() => {
  const {data, rows, escaped, short, date, largest, link, faultText} = faultlineIndex;
  const BLOCK = 40, NEAR_PX = 1500, GUESS_PX = 46;
  const WIDTH = 160, LANE = 6;

  function timeline(row) {
    if (!(row.end > row.start)) return '';
    const x = (t) => Math.min(Math.max((t - row.start) / (row.end - row.start), 0), 1) * WIDTH;
    const first = Math.min(1, ...row.faults.map((f) => f.joint));
    const last = Math.max(row.joints, 1, ...row.faults.map((f) => f.joint));
    const bar = (kind, from, to, y) => `<rect${kind} x="${from.toFixed(1)}" y="${y}" width="${
      Math.max(to - from, 1).toFixed(1)}" height="4"/>`;
    let lanes = '', bars = '';
    for (let j = first; j <= last; ++j) lanes += `M0 ${(j - first) * LANE + 3}h${WIDTH}`;
    for (const fault of row.faults) {
      if (fault.onset === null) continue;
      const onset = x(fault.onset), y = (fault.joint - first) * LANE + 1;
      const alarm = fault.alarm === null ? onset : Math.max(x(fault.alarm), onset);
      if (alarm - onset >= 0.1) bars += bar('', onset, alarm, y);
      bars += bar(' class="f"', alarm, fault.end === null ? WIDTH : x(fault.end), y);
    }
    return `<svg class="t" viewBox="0 0 160 ${(last - first + 1) * LANE}" aria-hidden="true"><path d="${lanes}"/>${
      bars}</svg>`;
  }

  const name = (row) => (row.result ? `<a href="${link(row)}">${escaped(row.log)}</a>` : escaped(row.log));
  const faults = (row) => row.faults.map((f) => escaped(faultText(row, f))).join('<br>') || escaped(row.reason);
  const onset = (row) => (row.faults.length ? row.faults[0].onset : null);
  const joints = (values) => values.map(short).join(', ') || '-';

  // `width` in rem; 0 shares what is left. `value` is what the column is sorted by.
  const columns = [
    {id: 'no', title: 'no.', width: 3.6, number: true, usual: true, value: (r) => r.no, cell: (r) => r.no},
    {id: 'log', title: 'log', width: 0, usual: true, value: (r) => r.log, cell: name},
    {id: 'verdict', title: 'verdict', width: 7, usual: true, value: (r) => r.verdict,
     cell: (r) => `<span class="${r.verdict}">${r.verdict}</span>` +
       (r.doubt ? `<br><span title="${escaped(r.doubt)}">doubtful model</span>` : '')},
    {id: 'faults', title: 'faults', width: 0, usual: true, cell: faults,
     value: (r) => (r.faults.length ? r.faults[0].words : r.reason || '\uffff')},
    {id: 'timeline', title: 'timeline', width: 11, usual: true, value: onset, cell: timeline},
    {id: 'residual', title: 'residual', width: 7, number: true, usual: true, value: (r) => r.residual,
     cell: (r) => short(r.residual)},
    {id: 'length', title: 'length, s', width: 7, number: true, usual: true,
     value: (r) => (r.end === null || r.start === null ? null : r.end - r.start),
     cell: (r) => (r.end === null || r.start === null ? '-' : short(r.end - r.start))},
    {id: 'issues', title: 'issues', width: 6, number: true, usual: true, value: (r) => r.issues,
     cell: (r) => r.issues},
    {id: 'model', title: 'model', width: 9, usual: data.models.length > 1, value: (r) => data.models[r.model] || '',
     cell: (r) => escaped(data.models[r.model] || '-')},
    {id: 'folder', title: 'folder', width: 11, value: (r) => r.folder, cell: (r) => escaped(r.folder)},
    {id: 'start', title: 'start', width: 9, value: (r) => r.start,
     cell: (r) => (r.start === null ? '-' : data.time ? date(r.start) : short(r.start) + ' s')},
    {id: 'rows', title: 'rows', width: 6.5, number: true, value: (r) => r.count, cell: (r) => r.count},
    {id: 'joints', title: 'residual by joint', width: 10, value: (r) => r.residual, cell: (r) => joints(r.rms)},
    {id: 'peak', title: 'residual peak', width: 6, number: true, value: (r) => largest(r.peak),
     cell: (r) => short(largest(r.peak))},
    {id: 'confidence', title: 'confidence', width: 7, number: true,
     value: (r) => (r.faults.length ? r.faults[0].confidence : null),
     cell: (r) => (r.faults.length ? Math.round(100 * r.faults[0].confidence) + ' %' : '-')},
  ];

  class Table {
    constructor(place, sort) {
      this.place = place;
      this.element = document.createElement('table');
      this.element.className = 'logs';
      this.element.id = 'logs';
      this.element.setAttribute('role', 'table');
      this.element.setAttribute('aria-label', 'Logs');
      place.append(this.element);
      this.sort = sort;
      this.marked = null;
      this.seen = new IntersectionObserver((entries) => {
        for (const entry of entries) this.turn(entry.target, entry.isIntersecting);
      }, {rootMargin: NEAR_PX + 'px'});
      addEventListener('resize', () => this.fit());
      addEventListener('beforeprint', () => { for (const body of this.element.tBodies) this.turn(body, true); });
    }

    show(list, shown, order) {
      this.list = list;
      if (shown !== this.shown || order !== this.order) {
        this.shown = shown;
        this.order = order;
        this.columns = columns.filter((column) => shown.includes(column.id));
        this.head();
      }
      this.seen.disconnect();
      for (const body of Array.from(this.element.tBodies)) body.remove();
      const bodies = document.createDocumentFragment();
      for (let i = 0; i < list.length; i += BLOCK) {
        const body = document.createElement('tbody');
        body.setAttribute('role', 'rowgroup');
        body.first = i;
        body.height = Math.min(BLOCK, list.length - i) * GUESS_PX;
        bodies.append(body);
        if (i === 0) this.fill(body); else this.empty(body);
      }
      this.element.append(bodies);
      this.element.setAttribute('aria-rowcount', list.length + 1);
      for (const body of this.element.tBodies) this.seen.observe(body);
      this.fit();
    }

    head() {
      const arrow = (id) => (this.order === id ? 'ascending' : this.order === '-' + id ? 'descending' : 'none');
      this.element.querySelectorAll('colgroup,thead').forEach((part) => part.remove());
      this.element.insertAdjacentHTML('afterbegin', '<colgroup>' + '<col>'.repeat(this.columns.length) +
        '</colgroup><thead role="rowgroup"><tr role="row">' + this.columns.map((c) =>
        `<th role="columnheader" scope="col" class="${c.number ? 'n' : ''}" aria-sort="${arrow(c.id)}"><button type="button" data-id="${
          c.id}">${c.title}</button></th>`).join('') + '</tr></thead>');
      this.columns.forEach((column, i) => {
        if (column.width) this.element.querySelectorAll('col')[i].style.width = column.width + 'rem';
      });
      for (const button of this.element.querySelectorAll('th button'))
        button.addEventListener('click', () => {
          this.sort(button.dataset.id);
          this.element.querySelector(`th button[data-id=${button.dataset.id}]`).focus();
        });
    }

    // A table that its page is too narrow for scrolls on its own.
    fit() {
      if (!this.columns) return;
      const least = this.columns.reduce((sum, column) => sum + (column.width || 11), 0);
      this.element.style.minWidth = least + 'rem';
      const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
      this.place.classList.toggle('wide', this.place.clientWidth < least * rem);
    }

    line(row, place) {
      const cells = this.columns.map((c) => `<td role="cell" class="${c.id}${c.number ? ' n' : ''}" data-title="${
        c.title}">${c.cell(row)}</td>`).join('');
      return `<tr role="row" data-no="${row.no}" aria-rowindex="${place + 2}"${
        row === this.marked ? ' class="marked"' : ''}>${cells}</tr>`;
    }

    fill(body) {
      const part = this.list.slice(body.first, body.first + BLOCK);
      body.innerHTML = part.map((row, i) => this.line(row, body.first + i)).join('');
      body.full = true;
    }

    empty(body) {
      body.innerHTML = '<tr class="gap" aria-hidden="true"><td></td></tr>';
      body.rows[0].style.height = body.height + 'px';
      body.full = false;
    }

    turn(body, near) {
      if (near && !body.full) return this.fill(body);
      if (near || !body.full || body.contains(document.activeElement)) return;
      body.height = body.getBoundingClientRect().height;
      this.empty(body);
    }

    // To the row of a log, marked and with the focus on its link.
    goTo(row) {
      const place = this.list.indexOf(row);
      if (place < 0) return;
      this.marked = row;
      for (const old of this.element.querySelectorAll('tr.marked')) old.classList.remove('marked');
      const body = this.element.tBodies[Math.floor(place / BLOCK)];
      this.fill(body);
      const line = body.rows[place % BLOCK];
      line.tabIndex = -1;
      (line.querySelector('a') || line).focus({preventScroll: true});
      line.scrollIntoView({block: 'center'});
    }
  }

  return {columns, Table, rows};
})();
