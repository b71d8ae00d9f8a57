// SPDX-License-Identifier: MIT
// The rows of the page (their form: index_page.hpp), the first at once and the others from packed parts, and their
// numbers as people read them.
'use strict';
const faultlineIndex = (() => {
  const data = JSON.parse(document.getElementById('index-facts').textContent);
  const rows = [];
  const MARKS = {'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;'};

  const escaped = (text) => text.replace(/[&<>"']/g, (mark) => MARKS[mark]);
  const short = (v) => (v === null || v === undefined || !isFinite(v) ? '-' :
    Math.abs(v) >= 1000 && Math.abs(v) < 1e7 ? String(Math.round(v)) : String(+v.toPrecision(3)));

  function time(seconds, period) {
    if (seconds === null) return 'unknown';
    const decimals = period > 0 ? Math.min(Math.max(Math.ceil(-Math.log10(period)), 3), 6) : 3;
    return seconds.toFixed(decimals) + ' s';
  }

  const date = (seconds) => new Date(1000 * seconds).toISOString().slice(0, 19).replace('T', ' ');
  const largest = (values) => values.reduce((a, b) => (b !== null && !(a >= b) ? b : a), null);
  const NONE = [];

  // A row of a part, whose columns it reads.
  class Row {
    constructor(part, i, no) {
      this.part = part;
      this.i = i;
      this.no = no;
      this.faults = NONE;
      this.residual = largest(this.rms);
    }
    value(column) { return this.part[column][this.i]; }
    get log() { return this.value('log'); }
    get folder() { return this.log.slice(0, Math.max(this.log.lastIndexOf('/'), 0)); }
    get verdict() { return this.value('verdict'); }
    get result() { return this.value('result'); }
    get reason() { return this.value('reason'); }
    get doubt() { return this.value('doubt'); }
    get model() { return this.value('model'); }
    get start() { return this.value('start'); }
    get end() { return this.value('end'); }
    get period() { return this.value('period'); }
    get joints() { return this.value('joints'); }
    get issues() { return this.value('issues'); }
    get count() { return this.value('count'); }
    get rms() { return this.part.rms.map((column) => column[this.i]); }
    get peak() { return this.part.peak.map((column) => column[this.i]); }
    // In small letters, what the search looks through.
    get words() {
      const faults = this.faults.map((fault) => fault.words + ' ' + fault.kind).join(' ');
      return (this.text ||= `${this.log} ${this.verdict} ${faults} ${this.reason}`.toLowerCase());
    }
  }

  function take(part) {
    const before = rows.length;
    for (let i = 0; i < part.log.length; ++i) rows.push(new Row(part, i, before + i + 1));
    for (const [i, label, joint, onset, alarm, end, confidence] of part.faults) {
      const row = rows[before + i], [kind, words] = data.labels[label];
      if (row.faults === NONE) row.faults = [];
      row.faults.push({kind, words, joint, onset, alarm, end, confidence});
    }
    part.faults = null;
  }

  async function unpacked(text) {
    const letters = atob(text), bytes = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).json();
  }

  // The next part of the page, which may still be loading; null behind the last.
  async function nextPart() {
    for (;;) {
      const element = document.querySelector('script.part');
      // The text of an element is whole when something follows it.
      if (element && (element.nextSibling || document.readyState !== 'loading')) return element;
      if (document.readyState !== 'loading') return null;
      await new Promise((parsed) => document.addEventListener('readystatechange', parsed, {once: true}));
    }
  }

  // The other rows. The scripts run while the page still loads.
  async function load() {
    while (rows.length < data.logs) {
      const element = await nextPart();
      if (!element) break;
      element.remove();
      take(await unpacked(element.textContent));
      await new Promise((drawn) => setTimeout(drawn));
    }
  }

  take(data.first);
  const link = (row) => (row.result ? `logs/${row.result}.${data.pages ? 'html' : 'json'}` : '');
  // Of a log that counts from 1970, from its own start.
  const when = (row, fault) => (row.start >= 1e5 && fault.onset !== null ?
    time(fault.onset - row.start, row.period) + ' after its start' : time(fault.onset, row.period));
  const faultText = (row, fault) =>
    `${fault.words} at ${when(row, fault)} (confidence ${Math.round(100 * fault.confidence)} %)`;

  return {data, rows, load, escaped, short, time, date, largest, link, faultText};
})();
