// SPDX-License-Identifier: MIT
// The numbers of the page as rows that can be drawn (their form: html_plot_data.hpp).
'use strict';
const faultlineSeries = (() => {
  const data = JSON.parse(document.getElementById('plot-data').textContent);
  const MISSING = 65535, STEPS = 65534;
  const decoded = new Map();

  function decode(window, key) {
    const id = window.fault + ' ' + key;
    if (decoded.has(id)) return decoded.get(id);
    const [low, high, text] = window.keys[key];
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    const values = new Float64Array(bytes.length / 2);
    for (let i = 0; i < values.length; ++i) {
      const code = view.getUint16(2 * i, true);
      const value = code === MISSING ? NaN : low + (high - low) * code / STEPS;
      values[i] = key[0] === 'r' ? Math.pow(10, value) : value;
    }
    decoded.set(id, values);
    return values;
  }

  // Rows [time, value of each key] of one window, or of a trace.
  function rowsOf(part, keys) {
    if (part.times) return part.times.map((t, i) => [t, ...keys.map((k) => part.keys[k][i])]);
    const columns = keys.map((k) => (k in part.keys ? decode(part, k) : null));
    const count = Math.max(...columns.map((c) => (c ? c.length : 0)));
    const rows = new Array(count);
    for (let i = 0; i < count; ++i) {
      const row = [part.from + (part.to - part.from) * (i + 0.5) / count];
      for (const column of columns) row.push(column ? column[i] : NaN);
      rows[i] = row;
    }
    return rows;
  }

  // The whole run; with `closely`, the finer rows of the windows around faults in their places.
  function rowsOfFigure(figure, closely) {
    const keys = figure.curves.map((c) => c[1]);
    const trace = data.traces.find((t) => keys[0] in t.keys);
    if (trace) return rowsOf(trace, keys);
    const parts = data.windows.filter((w) => keys[0] in w.keys);
    const coarse = parts.filter((w) => w.fault === 0);
    const fine = parts.filter((w) => w.fault > 0 && (closely || coarse.length === 0));
    let rows = [];
    let end = -Infinity;
    for (const part of fine) {
      for (const row of rowsOf(part, keys)) if (row[0] > end) rows.push(row);
      end = Math.max(end, part.to);
    }
    for (const part of coarse)
      for (const row of rowsOf(part, keys))
        if (!fine.some((w) => row[0] >= w.from && row[0] <= w.to)) rows.push(row);
    return rows.sort((a, b) => a[0] - b[0]);
  }

  function nearestRow(rows, time) {
    let low = 0, high = rows.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (rows[middle][0] < time) low = middle; else high = middle;
    }
    return rows.length && Math.abs(rows[low][0] - time) <= Math.abs(rows[high][0] - time) ? low : high;
  }

  return {data, rowsOfFigure, nearestRow};
})();
