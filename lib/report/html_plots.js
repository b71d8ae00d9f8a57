// SPDX-License-Identifier: MIT
// Puts interactive plots (dygraphs) where the page has pictures. All plots of a group, the whole run or the
// surroundings of one fault, share zoom and cursor. Without this script the pictures stay.
'use strict';
(function () {
  const data = JSON.parse(document.getElementById('plot-data').textContent);
  const MISSING = 65535, STEPS = 65534;
  const DASHES = [null, [7, 3], [2, 2.5], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2]];
  const decoded = new Map();
  const groups = new Map();

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

  // The whole run, with the finer rows of the windows around faults in their places.
  function rowsOfFigure(figure) {
    const keys = figure.curves.map((c) => c[1]);
    const trace = data.traces.find((t) => keys[0] in t.keys);
    if (trace) return rowsOf(trace, keys);
    const parts = data.windows.filter((w) => keys[0] in w.keys);
    const fine = parts.filter((w) => w.fault > 0);
    const coarse = parts.filter((w) => w.fault === 0);
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

  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  function short(value) {
    if (value === null || !isFinite(value)) return '-';
    const size = Math.abs(value);
    return size !== 0 && (size >= 1e5 || size < 1e-3) ? value.toExponential(2) : String(+value.toPrecision(4));
  }

  function nearestRow(rows, time) {
    let low = 0, high = rows.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (rows[middle][0] < time) low = middle; else high = middle;
    }
    return rows.length && Math.abs(rows[low][0] - time) <= Math.abs(rows[high][0] - time) ? low : high;
  }

  class Group {
    constructor(fault, figures) {
      this.fault = fault;
      this.home = [Math.min(...figures.map((f) => f.from)), Math.max(...figures.map((f) => f.to))];
      const whole = data.windows[0];
      this.limit = [whole.from, whole.to];
      this.range = this.home.slice();
      this.plots = [];
    }

    zoom(from, to) {
      const least = (this.limit[1] - this.limit[0]) * 1e-7;
      let width = Math.min(Math.max(to - from, least), this.limit[1] - this.limit[0]);
      from = Math.min(Math.max(from, this.limit[0]), this.limit[1] - width);
      this.range = [from, from + width];
      for (const plot of this.plots) plot.show(this.range);
    }

    pan(share) {
      const step = share * (this.range[1] - this.range[0]);
      this.zoom(this.range[0] + step, this.range[1] + step);
    }

    scale(factor) {
      const middle = (this.range[0] + this.range[1]) / 2, half = factor * (this.range[1] - this.range[0]) / 2;
      this.zoom(middle - half, middle + half);
    }

    reset() { this.zoom(this.home[0], this.home[1]); }
    point(time) { for (const plot of this.plots) plot.point(time); }
    unpoint() { for (const plot of this.plots) plot.unpoint(); }
  }

  class Plot {
    constructor(figure, element, group) {
      this.figure = figure;
      this.group = group;
      this.visible = true;
      this.stale = false;
      this.rows = rowsOfFigure(figure);
      this.live = element.querySelector('.live');
      this.values = element.querySelectorAll('.legend b');
      const names = figure.curves.map((c, i) => i + ' ' + c[0]);
      const series = {};
      names.forEach((name, i) => {
        series[name] = {strokePattern: DASHES[i % 6], strokeWidth: 1.4};
      });
      this.graph = new Dygraph(this.live, this.rows, Object.assign({
        labels: ['time'].concat(names), series,  logscale: figure.log,
        dateWindow: group.range.slice(), valueRange: this.valueRange(), connectSeparatedPoints: false,
        highlightCircleSize: 3, animatedZooms: false, xRangePad: 0, axisLabelFontSize: 12,
        axes: {x: {axisLabelFormatter: (x) => short(x) + ' s', valueFormatter: (x) => String(x)},
               y: {axisLabelWidth: 62, axisLabelFormatter: (y) => short(y)}},
        highlightCallback: (event, x) => group.point(x),
        unhighlightCallback: () => group.unpoint(),
        underlayCallback: (context, area, graph) => this.underlay(context, area, graph),
        zoomCallback: (from, to) => group.zoom(from, to),
        drawCallback: (graph) => this.drawn(graph),
      }, this.colours()));
      this.cursor = document.createElement('div');
      this.cursor.className = 'cursor';
      this.live.appendChild(this.cursor);
      this.live.addEventListener('keydown', (event) => this.key(event));
      this.live.addEventListener('dblclick', (event) => { event.stopPropagation(); group.reset(); }, true);
      this.live.dataset.range = group.range.join(' ');
      const keys = ' Arrow keys move, plus and minus zoom, Escape shows all.';
      this.live.setAttribute('aria-label', this.live.getAttribute('aria-label') + keys);
    }

    // Wide enough for the limits too.
    valueRange() {
      let low = Infinity, high = -Infinity;
      for (const row of this.rows)
        for (let i = 1; i < row.length; ++i) {
          if (!(this.figure.log ? row[i] > 0 : isFinite(row[i])) || row[i] === null) continue;
          low = Math.min(low, row[i]);
          high = Math.max(high, row[i]);
        }
      for (const limit of this.figure.limits) low = Math.min(low, limit), high = Math.max(high, limit);
      if (!(low <= high)) return this.figure.log ? [0.1, 10] : [-1, 1];
      if (this.figure.least !== null) low = Math.min(Math.max(low, this.figure.least), high);
      if (this.figure.log) return [low * 0.8, high * 1.4];
      const margin = (high - low) * 0.06 || Math.abs(high) * 0.1 || 1;
      return [low - margin, high + margin];
    }

    colours() {
      return {colors: this.figure.curves.map((c, i) => colour('--pen' + i % 6)), gridLineColor: colour('--grid'),
              axisLabelColor: colour('--soft'),
              axisLineColor: colour('--line')};
    }

    recolour() { this.graph.updateOptions(this.colours()); }

    underlay(context, area, graph) {
      context.save();
      context.lineWidth = 1.4;
      this.figure.limits.forEach((limit, i) => {
        const y = graph.toDomYCoord(limit);
        context.strokeStyle = colour('--pen' + (this.figure.curves.length + i) % 6);
        context.setLineDash(DASHES[(this.figure.curves.length + i) % 6] || []);
        context.beginPath();
        context.moveTo(area.x, y);
        context.lineTo(area.x + area.w, y);
        context.stroke();
      });
      context.strokeStyle = context.fillStyle = colour('--bad');
      context.setLineDash([5, 3]);
      context.font = '12px sans-serif';
      const marks = this.figure.marks.map(([time, text]) => [graph.toDomXCoord(time), text])
        .filter(([x]) => x >= area.x && x <= area.x + area.w);
      marks.forEach(([x, text], i) => {
        context.beginPath();
        context.moveTo(x, area.y);
        context.lineTo(x, area.y + area.h);
        context.stroke();
        // A word that would reach into the next line stands on the other side.
        const width = context.measureText(text).width + 8;
        const next = i + 1 < marks.length ? marks[i + 1][0] : area.x + area.w;
        const left = next - x < width && x - area.x > width;
        context.textAlign = left ? 'right' : 'left';
        context.fillText(text, left ? x - 4 : x + 4, area.y + 13);
      });
      context.restore();
    }

    // A plot out of sight waits until it is scrolled to.
    show(range) {
      this.stale = !this.visible;
      if (this.stale) return;
      const now = this.graph.xAxisRange();
      this.live.dataset.range = range.join(' ');
      if (now[0] !== range[0] || now[1] !== range[1])
        this.graph.updateOptions({dateWindow: range.slice(), valueRange: this.valueRange()});
    }

    // Moving a plot by hand moves the others of its group.
    drawn(graph) {
      if (!this.graph || this.group.moving) return;
      const [from, to] = graph.xAxisRange();
      if (from === this.group.range[0] && to === this.group.range[1]) return;
      this.group.moving = true;
      this.group.zoom(from, to);
      this.group.moving = false;
    }

    point(time) {
      const row = nearestRow(this.rows, time);
      this.values.forEach((value, i) => {
        value.textContent = i < this.figure.curves.length && this.rows[row] ? short(this.rows[row][i + 1]) : '';
      });
      const x = this.graph.toDomXCoord(time);
      this.cursor.style.left = x + 'px';
      this.cursor.style.display = 'block';
    }

    unpoint() {
      this.cursor.style.display = 'none';
      this.values.forEach((value) => { value.textContent = ''; });
    }

    key(event) {
      const action = {ArrowLeft: () => this.group.pan(-0.2), ArrowRight: () => this.group.pan(0.2),
                      '+': () => this.group.scale(0.5), '=': () => this.group.scale(0.5),
                      '-': () => this.group.scale(2), Escape: () => this.group.reset()}[event.key];
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      action();
      event.preventDefault();
    }
  }

  // The page has legends of its own, and that of dygraphs writes style attributes, which the policy forbids.
  Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);
  const waiting = new Map();
  const drawn = new Map();

  function comeIntoSight(element) {
    const plot = drawn.get(element);
    if (plot) {
      plot.visible = true;
      if (plot.stale) plot.show(plot.group.range);
      return;
    }
    if (!element.classList.contains('drawn')) return;
    const figure = waiting.get(element);
    const group = groups.get(figure.fault);
    try {
      drawn.set(element, new Plot(figure, element, group));
      group.plots.push(drawn.get(element));
    } catch (error) {
      element.classList.remove('drawn');  // the picture comes back
      console.error(error);
    }
  }

  function leaveSight(element) {
    if (drawn.has(element)) drawn.get(element).visible = false;
  }

  function addTools(group) {
    const place = document.querySelector('.tools[data-fault="' + group.fault + '"]');
    if (!place) return;
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = 'Reset zoom';
    button.addEventListener('click', () => group.reset());
    const help = document.createElement('span');
    help.textContent = 'Drag to zoom, shift and drag to move, double click to reset; keys: arrows, +, -, Escape.';
    place.append(button, help);
  }

  for (const figure of data.figures) {
    if (!groups.has(figure.fault)) {
      groups.set(figure.fault, new Group(figure.fault, data.figures.filter((f) => f.fault === figure.fault)));
      addTools(groups.get(figure.fault));
    }
    waiting.set(document.getElementById(figure.id), figure);
  }
  const seen = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      if (entry.isIntersecting) comeIntoSight(entry.target);
      else leaveSight(entry.target);
    }
  }, {rootMargin: '400px'});
  for (const element of waiting.keys()) {
    element.classList.add('drawn');  // all at once, so that nothing moves while somebody reads
    seen.observe(element);
  }

  // A click in the timeline goes to the fault and shows its time in the plots of the whole run, too.
  for (const link of document.querySelectorAll('a[data-fault]'))
    link.addEventListener('click', () => {
      const fault = Number(link.dataset.fault);
      const window = data.windows.find((w) => w.fault === fault);
      const onset = Number(link.dataset.onset), run = data.windows[0], around = (run.to - run.from) / 40;
      if (groups.has(0) && window) groups.get(0).zoom(window.from, window.to);
      else if (groups.has(0) && isFinite(onset)) groups.get(0).zoom(onset - around, onset + around);
      if (groups.has(fault)) groups.get(fault).reset();
    });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    for (const group of groups.values()) for (const plot of group.plots) plot.recolour();
  });
})();
