// SPDX-License-Identifier: MIT
// The rows of the page (their form: index_page.hpp) and their numbers as people read them.
'use strict';
const faultlineIndex = (() => {
  const data = JSON.parse(document.getElementById('index-data').textContent);
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

  function rowOf(given, i) {
    const [log, verdict, model, result, faults, reason, start, end, period, joints, issues, count, rms, peak,
      condition, parameters, doubt] = given;
    const folder = log.slice(0, Math.max(log.lastIndexOf('/'), 0));
    return {no: i + 1, log, folder, verdict, model, result, reason, start, end, period, joints, issues, count, rms,
            peak, condition, parameters, doubt, residual: largest(rms),
            faults: faults.map(([label, joint, onset, alarm, stop, confidence]) =>
              ({kind: data.labels[label][0], words: data.labels[label][1], joint, onset, alarm, end: stop, confidence}))};
  }

  const rows = data.rows.map(rowOf);
  data.rows = null;
  const link = (row) => (row.result ? `logs/${row.result}.${data.pages ? 'html' : 'json'}` : '');
  // Of a log that counts from 1970, from its own start.
  const when = (row, fault) => (row.start >= 1e5 && fault.onset !== null ?
    time(fault.onset - row.start, row.period) + ' after its start' : time(fault.onset, row.period));
  const faultText = (row, fault) =>
    `${fault.words} at ${when(row, fault)} (confidence ${Math.round(100 * fault.confidence)} %)`;

  return {data, rows, escaped, short, time, date, largest, link, faultText};
})();
