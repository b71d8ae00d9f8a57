// SPDX-License-Identifier: MIT
// All plots of trends: they zoom together and show what the filters leave.
'use strict';
const faultlineTrendGroup = (() => {
  const {data} = faultlineIndex;
  const {judge, judged, panels} = faultlineTrends;
  const {Plot} = faultlineTrendPlot;
  const LEAST = 4;  // logs in sight

  const group = {
    limit: null, range: null, passes: null, plots: [], goTo: () => {},
    zoom(from, to) {
      const all = this.limit[1] - this.limit[0], width = Math.min(Math.max(to - from, Math.min(LEAST, all)), all);
      from = Math.min(Math.max(from, this.limit[0]), this.limit[1] - width);
      this.range = [from, from + width];
      this.draw();
    },
    pan(share) {
      const by = share * (this.range[1] - this.range[0]);
      this.zoom(this.range[0] + by, this.range[1] + by);
    },
    scale(factor, point) {
      const inside = point && point.at >= this.range[0] && point.at <= this.range[1];
      const middle = inside ? point.at : (this.range[0] + this.range[1]) / 2;
      const half = factor * (this.range[1] - this.range[0]) / 2;
      this.zoom(middle - half, middle + half);
    },
    reset() { this.zoom(this.limit[0], this.limit[1]); },
    draw() {
      document.getElementById('trends-live').dataset.range = this.range.join(' ');
      for (const plot of this.plots) if (plot.near) plot.draw(); else plot.stale = true;
    },
    // Only these logs are shown; null: all.
    show(passing) {
      this.passes = passing;
      this.draw();
    },
  };

  function tools(place) {
    const bar = document.createElement('div');
    bar.className = 'zoom';
    const add = (text, label, action) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = text;
      button.setAttribute('aria-label', label);
      button.addEventListener('click', action);
      bar.append(button);
    };
    add('+', 'Zoom in', () => group.scale(0.5));
    add('−', 'Zoom out', () => group.scale(2));
    add('◀', 'Move to earlier logs', () => group.pan(-0.4));
    add('▶', 'Move to later logs', () => group.pan(0.4));
    add('All', 'Show all logs', () => group.reset());
    bar.insertAdjacentHTML('beforeend', `<span class="key"><svg viewBox="0 0 10 10" aria-hidden="true"><circle cx="5" cy="5" r="4"/></svg>healthy</span>
      <span class="key bad"><svg viewBox="0 0 10 10" aria-hidden="true"><path d="M5 0L10 9H0Z"/></svg>faulty</span>
      <span class="help">Judged logs in the order of ${data.time ? 'their start' : 'names'}. Drag to zoom, double click for all; keys: arrows, +, −, Page Up and Down, Enter to the links, Escape.</span>`);
    place.append(bar);
  }

  // When all rows are there.
  function start(goTo) {
    const place = document.getElementById('trends-live');
    if (!place) return;
    judge();
    group.limit = [0.5, judged.length + 0.5];
    group.range = group.limit;
    group.goTo = goTo;
    tools(place);
    const come = (figure) => {
      if (!figure.plot) group.plots.push(figure.plot = new Plot(figure.panel, group, figure));
      figure.plot.near = true;
      figure.plot.draw();
    };
    const seen = new IntersectionObserver((entries) => {
      for (const {target, isIntersecting} of entries) {
        if (isIntersecting) come(target);
        else if (target.plot) target.plot.near = false;
      }
    }, {rootMargin: '200px'});
    for (const panel of panels()) {
      const figure = document.createElement('figure');
      place.append(figure);
      figure.panel = panel;
      seen.observe(figure);
    }
    new ResizeObserver(() => group.draw()).observe(place);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => group.draw());
    addEventListener('beforeprint', () => place.querySelectorAll('figure').forEach(come));
  }

  return {start, show: (passing) => group.limit && group.show(passing)};
})();
