// SPDX-License-Identifier: MIT
// Interactive plots by dygraphs. All plots of a group, the whole run or the surroundings of one fault, share zoom
// and cursor.
'use strict';
const faultlinePlots = (() => {
  const {data, rowsOfFigure, nearestRow} = faultlineSeries;
  const DASHES = [null, [7, 3], [2, 2.5], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2]];

  // A finger scrolls the page; buttons zoom.
  const INTERACTION = Object.assign({}, Dygraph.defaultInteractionModel);
  for (const touch of ['touchstart', 'touchmove', 'touchend']) delete INTERACTION[touch];

  function colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }

  function short(value) {
    if (value === null || !isFinite(value)) return '-';
    const size = Math.abs(value);
    return size !== 0 && (size >= 1e5 || size < 0.01) ? value.toExponential(2) : String(+value.toPrecision(4));
  }

  // With as many decimals as tell neighbouring ticks of an axis apart.
  function tick(value, [low, high]) {
    if (Math.abs(value) >= 1e6 || !(high > low)) return short(value);
    const decimals = Math.ceil(-Math.log10((high - low) / 12));
    return value.toFixed(Math.min(Math.max(decimals, 0), 12)).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
  }

  // With as many decimals as tell neighbouring rows apart.
  function moment(time, rows) {
    const step = rows.length > 1 ? (rows[rows.length - 1][0] - rows[0][0]) / (rows.length - 1) : 1;
    return time.toFixed(Math.min(Math.max(Math.ceil(-Math.log10(step)), 0), 6)) + ' s';
  }

  // Where the word of a line stands: beside it, on the side that crosses no other line, in the first row where it
  // covers no other word.
  function placedWord(x, width, area, lines, words) {
    const right = {from: x + 4, to: x + 8 + width}, left = {from: x - 4 - width, to: x};
    for (let row = 0; row < 3; ++row)
      for (const {from, to} of [right, left]) {
        const inside = from >= area.x && to <= area.x + area.w;
        const crossed = row === 0 && lines.some((line) => line > Math.min(from, x) && line < Math.max(to, x) && line !== x);
        if (inside && !crossed && !words.some((w) => w.row === row && w.from < to && from < w.to)) return {from, to, row};
      }
    return {...right, row: 0};
  }

  class Group {
    constructor(figures) {
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
      this.coarse = rowsOfFigure(figure, false);
      this.fine = rowsOfFigure(figure, true);
      this.rows = this.rowsFor(group.range);
      this.live = element.querySelector('.live');
      this.time = element.querySelector('.legend .at b');
      this.values = element.querySelectorAll('.legend li:not(.at) b');
      this.span = this.valueRange();
      const names = figure.curves.map((c, i) => i + ' ' + c[0]);
      const series = {};
      names.forEach((name, i) => {
        series[name] = {strokePattern: DASHES[figure.curves[i][2] % 6], strokeWidth: 1.4};
      });
      this.graph = new Dygraph(this.live, this.rows, Object.assign({
        labels: ['time'].concat(names), series, logscale: figure.log,
        dateWindow: group.range.slice(), valueRange: this.span, connectSeparatedPoints: false,
        interactionModel: INTERACTION, highlightCircleSize: 3,
        animatedZooms: false, xRangePad: 0, axisLabelFontSize: 12,
        axes: {x: {pixelsPerLabel: 50, axisLabelFormatter: (x) => tick(x, group.range) + ' s',
                   valueFormatter: (x) => String(x)},
               y: {axisLabelWidth: 62, axisLabelFormatter: (y) => (figure.log ? short(y) : tick(y, this.span))}},
        highlightCallback: (event, x) => group.point(x),
        unhighlightCallback: () => group.unpoint(),
        underlayCallback: (context, area, graph) => this.underlay(context, area, graph),
        zoomCallback: (from, to) => group.zoom(from, to),
        drawCallback: (graph) => this.drawn(graph),
      }, this.colours()));
      for (const child of this.live.children) child.setAttribute('aria-hidden', 'true');
      this.cursor = document.createElement('div');
      this.cursor.className = 'cursor';
      this.live.appendChild(this.cursor);
      this.live.addEventListener('keydown', (event) => this.key(event));
      this.live.addEventListener('dblclick', (event) => { event.stopPropagation(); group.reset(); }, true);
      this.live.dataset.range = group.range.join(' ');
      const keys = ' Arrow keys move, plus and minus zoom, Escape shows all.';
      this.live.setAttribute('aria-label', this.live.getAttribute('aria-label') + keys);
    }

    // The finer rows around faults are for those who look closely: from afar they would stand out as spikes.
    rowsFor(range) {
      const widest = Math.max(0, ...data.windows.slice(1).map((w) => w.to - w.from));
      return range[1] - range[0] > 10 * widest ? this.coarse : this.fine;
    }

    // Of all rows, so that zooming does not change it; wide enough for the limits too.
    valueRange() {
      let low = Infinity, high = -Infinity;
      for (const row of this.fine)
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
      return {colors: this.figure.curves.map((c) => colour('--pen' + c[2] % 6)), gridLineColor: colour('--grid'),
              axisLabelColor: colour('--soft'),
              axisLineColor: colour('--axis')};
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
      const lines = marks.map(([x]) => x), words = [];
      for (const [x, text] of marks) {
        context.beginPath();
        context.moveTo(x, area.y);
        context.lineTo(x, area.y + area.h);
        context.stroke();
        const word = placedWord(x, context.measureText(text).width, area, lines, words);
        words.push(word);
        context.fillText(text, word.from, area.y + 13 + 14 * word.row);
      }
      context.restore();
    }

    // A plot out of sight waits until it is scrolled to.
    show(range) {
      this.stale = !this.visible;
      if (this.stale) return;
      const now = this.graph.xAxisRange();
      this.live.dataset.range = range.join(' ');
      if (now[0] === range[0] && now[1] === range[1]) return;
      const options = {dateWindow: range.slice(), valueRange: this.span};
      const rows = this.rowsFor(range);
      if (rows !== this.rows) options.file = this.rows = rows;
      this.graph.updateOptions(options);
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
      this.time.textContent = moment(time, this.rows);
      this.values.forEach((value, i) => {
        value.textContent = this.rows[row] ? short(this.rows[row][i + 1]) : '';
      });
      const x = this.graph.toDomXCoord(time);
      this.cursor.style.left = x + 'px';
      this.cursor.style.display = 'block';
    }

    unpoint() {
      this.cursor.style.display = 'none';
      this.time.textContent = '';
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

  return {Group, Plot};
})();
