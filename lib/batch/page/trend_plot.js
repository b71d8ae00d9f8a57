// SPDX-License-Identifier: MIT
// One plot of trends on a canvas: healthy logs are dots in the colour of their curve, faulty ones red triangles.
// It is a slider over the logs for keyboards and screen readers.
'use strict';
const faultlineTrendPlot = (() => {
  const {data, short, date, link} = faultlineIndex;
  const HEIGHT = 210, LEFT = 52, RIGHT = 10, TOP = 8, BOTTOM = 24, PENS = 6, NEAR_PX = 40, WHISKERS = 300;
  const DASHES = [[], [7, 3], [2, 2.5], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2]];
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const faulty = (point) => point.row.verdict === 'faulty';

  function step(span, count) {
    const power = Math.pow(10, Math.floor(Math.log10(span / count)));
    return power * [1, 2, 5, 10].find((factor) => factor * power * count >= span);
  }

  function ticks(low, high, log) {
    const found = [];
    if (log && high / low > 8) {
      for (let e = Math.ceil(Math.log10(low) - 1e-9); Math.pow(10, e) <= high; ++e) found.push(Math.pow(10, e));
      return found;
    }
    const each = step(high - low, 4);
    for (let i = Math.ceil(low / each); i * each <= high; ++i) found.push(i * each);
    return found;
  }

  // Of points that share some pixels only the largest and the smallest, healthy and faulty apart.
  function thinned(points, x) {
    const kept = new Map();
    for (const point of points) {
      const key = 2 * Math.floor(x(point.at) / 3) + faulty(point);
      const pair = kept.get(key);
      if (!pair) kept.set(key, [point, point]);
      else if (point.y < pair[0].y) pair[0] = point;
      else if (point.y > pair[1].y) pair[1] = point;
    }
    return Array.from(kept.values()).flatMap(([low, high]) => (low === high ? [low] : [low, high]))
      .sort((a, b) => a.at - b.at);
  }

  class Plot {
    constructor(panel, group, element) {
      Object.assign(this, {panel, group, hidden: new Set(), point: null, pinned: false});
      panel.curves = panel.make();
      element.innerHTML = '<figcaption></figcaption><ul class="legend"></ul><p class="told"></p><canvas></canvas>';
      element.querySelector('figcaption').textContent = panel.title;
      this.told = element.querySelector('.told');
      this.canvas = element.querySelector('canvas');
      this.legend(element.querySelector('.legend'));
      const facts = {tabindex: 0, role: 'slider', 'aria-label': panel.title + ' by log', 'aria-valuemin': 1,
                     'aria-valuemax': group.limit[1], 'aria-orientation': 'horizontal'};
      for (const [name, value] of Object.entries(facts)) this.canvas.setAttribute(name, value);
      this.listen();
      this.tell(null);
    }

    legend(list) {
      this.panel.curves.forEach((curve, i) => {
        const entry = document.createElement('li'), button = document.createElement('button');
        button.type = 'button';
        button.setAttribute('aria-pressed', 'true');
        button.innerHTML = `<svg viewBox="0 0 26 8" aria-hidden="true"><line x1="0" x2="26" y1="4" y2="4" class="p${
          i % PENS}" stroke-dasharray="${DASHES[Math.floor(i / PENS + i) % PENS].join(' ')}"/></svg>`;
        button.append(curve.name);
        button.addEventListener('click', () => {
          if (!this.hidden.delete(i)) this.hidden.add(i);
          button.setAttribute('aria-pressed', String(!this.hidden.has(i)));
          this.draw();
        });
        entry.append(button);
        list.append(entry);
      });
    }

    listen() {
      const at = (event) => event.clientX - this.canvas.getBoundingClientRect().left;
      let from = null;
      this.canvas.addEventListener('pointerdown', (event) => {
        from = at(event);
        if (event.pointerType === 'mouse') this.canvas.setPointerCapture(event.pointerId);
      });
      this.canvas.addEventListener('pointermove', (event) => {
        this.band = from !== null && event.pointerType === 'mouse' ? [from, at(event)] : null;
        if (!this.pinned && !this.band) this.tell(this.nearest(event));
        this.draw();
      });
      this.canvas.addEventListener('pointerup', (event) => {
        const band = this.band;
        this.band = from = null;
        if (band && Math.abs(band[1] - band[0]) > 5) {
          const ends = band.map((x) => this.place(x)).sort((a, b) => a - b);
          return this.group.zoom(ends[0], ends[1]);
        }
        const point = this.nearest(event);
        this.pinned = point !== null;
        this.tell(point);
        this.draw();
      });
      this.canvas.addEventListener('pointercancel', () => { this.band = from = null; });
      this.canvas.addEventListener('pointerleave', () => { if (!this.pinned) this.tell(null); this.draw(); });
      this.canvas.addEventListener('dblclick', () => this.group.reset());
      this.canvas.addEventListener('focus', () => { if (!this.point) this.move(0, 0); });
      this.canvas.addEventListener('keydown', (event) => this.key(event));
    }

    key(event) {
      const group = this.group;
      const action = {ArrowLeft: () => this.move(-1, 0), ArrowRight: () => this.move(1, 0),
                      ArrowUp: () => this.move(0, -1), ArrowDown: () => this.move(0, 1),
                      Home: () => this.move(-Infinity, 0), End: () => this.move(Infinity, 0),
                      PageUp: () => group.pan(-0.5), PageDown: () => group.pan(0.5),
                      '+': () => group.scale(0.5, this.point), '=': () => group.scale(0.5, this.point),
                      '-': () => group.scale(2, this.point), Escape: () => { this.pinned = false; group.reset(); },
                      Enter: () => { const to = this.told.querySelector('a,button'); if (to) to.focus(); }}[event.key];
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      action();
      event.preventDefault();
    }

    // To the next log of the curve, or to the same log of the next curve.
    move(logs, curves) {
      const shown = this.panel.curves.map((curve, i) => i).filter((i) => !this.hidden.has(i) && this.seen(i).length);
      if (!shown.length) return;
      const before = Math.max(shown.indexOf(this.curve), 0);
      this.curve = shown[Math.min(Math.max(before + curves, 0), shown.length - 1)];
      const points = this.seen(this.curve);
      let now = this.point ? points.findIndex((p) => p.at >= this.point.at) : points.findIndex((p) => p.at >= this.group.range[0]);
      if (now < 0) now = points.length - 1;
      const point = points[Math.min(Math.max(now + logs, 0), points.length - 1)];
      this.pinned = true;
      if (point.at < this.group.range[0] || point.at > this.group.range[1])
        this.group.pan((point.at - (this.group.range[0] + this.group.range[1]) / 2) / (this.group.range[1] - this.group.range[0]));
      this.tell(point, this.curve);
      this.draw();
    }

    // Points of a curve that the filters leave.
    seen(i) {
      const curve = this.panel.curves[i];
      if (!this.group.passes) return curve.points;
      if (curve.passes !== this.group.passes) {
        curve.passes = this.group.passes;
        curve.left = curve.points.filter((point) => curve.passes.has(point.row));
      }
      return curve.left;
    }

    nearest(event) {
      const box = this.canvas.getBoundingClientRect();
      const x = event.clientX - box.left, y = event.clientY - box.top;
      let found = null, least = NEAR_PX * NEAR_PX;
      (this.drawn || []).forEach(({point, curve, px, py}) => {
        const distance = (px - x) * (px - x) + (py - y) * (py - y);
        if (distance < least) [least, found, this.curve] = [distance, point, curve];
      });
      return found;
    }

    // Name, time and value of a point, and the ways to its log.
    tell(point, curve = this.curve) {
      if (point && point === this.point && this.told.dataset.curve === String(curve)) return;
      this.point = point;
      this.told.dataset.curve = curve;
      if (!point) {
        this.told.textContent = 'Point at a log, or move through them with the arrow keys.';
        this.canvas.setAttribute('aria-valuenow', 1);
        this.canvas.setAttribute('aria-valuetext', 'no log chosen');
        return;
      }
      const {row, y, half} = point;
      const interval = half ? ` (95 %: ${short(y - half)} to ${short(y + half)})` : '';
      const when = row.start === null ? '' : data.time ? ', ' + date(row.start) : '';
      const what = row.faults.length ? ', ' + row.faults.map((f) => f.words).join('; ') : ', ' + row.verdict;
      const text = `${when}, ${this.panel.curves[curve].name}: ${short(y)}${interval}${what}. `;
      const name = document.createElement(row.result ? 'a' : 'b'), button = document.createElement('button');
      name.textContent = row.log;
      if (row.result) name.href = link(row);
      button.type = 'button';
      button.textContent = 'Show its row';
      button.addEventListener('click', () => this.group.goTo(row));
      this.told.replaceChildren(name, text, button);
      this.canvas.setAttribute('aria-valuenow', point.at);
      this.canvas.setAttribute('aria-valuetext', row.log + text);
    }

    place(x) {
      const [from, to] = this.group.range;
      return from + (x - LEFT) / (this.canvas.clientWidth - LEFT - RIGHT) * (to - from);
    }

    spanOf(curves) {
      let low = Infinity, high = -Infinity;
      for (const {points} of curves)
        for (const {y, half} of points) {
          if (this.panel.log && y <= 0) continue;
          low = Math.min(low, this.panel.log ? y : y - half);
          high = Math.max(high, y + half);
        }
      if (this.panel.zero) low = Math.min(low, 0);
      if (!(low <= high)) return this.panel.log ? [0.1, 10] : [0, 1];
      if (this.panel.log) return [low / 1.25, high * 1.25];
      const margin = (high - low) * 0.08 || Math.abs(high) * 0.1 || 1;
      return [low - (this.panel.zero && low === 0 ? 0 : margin), high + margin];
    }

    draw() {
      const width = this.canvas.clientWidth, sharp = devicePixelRatio || 1;
      if (!width) return;
      this.canvas.width = Math.round(width * sharp);
      this.canvas.height = Math.round(HEIGHT * sharp);
      const pen = this.canvas.getContext('2d');
      pen.scale(sharp, sharp);
      const [from, to] = this.group.range, right = width - RIGHT, bottom = HEIGHT - BOTTOM;
      const x = (at) => LEFT + (at - from) / (to - from) * (right - LEFT);
      const curves = this.panel.curves.map((curve, i) => ({
        i, points: this.hidden.has(i) ? [] : thinned(this.seen(i).filter((p) => p.at >= from && p.at <= to), x)}));
      const [low, high] = this.spanOf(curves), scale = this.panel.log ? Math.log : (v) => v;
      const y = (v) => bottom - (scale(v) - scale(low)) / (scale(high) - scale(low)) * (bottom - TOP);
      this.axes(pen, {x, y, low, high, right, bottom});
      pen.save();
      pen.beginPath();
      pen.rect(LEFT - 6, 0, right - LEFT + 12, bottom + 6);
      pen.clip();
      this.drawn = [];
      for (const {i, points} of curves) this.curveOn(pen, i, points, x, y);
      this.points(pen);
      pen.restore();
      if (this.band) {
        pen.fillStyle = colour('--link') + '33';
        pen.fillRect(Math.min(...this.band), TOP, Math.abs(this.band[1] - this.band[0]), bottom - TOP);
      }
    }

    curveOn(pen, i, points, x, y) {
      pen.strokeStyle = colour('--pen' + i % PENS);
      pen.lineWidth = 1;
      pen.globalAlpha = 0.55;
      pen.setLineDash(DASHES[Math.floor(i / PENS + i) % PENS]);
      pen.beginPath();
      for (const point of points) {
        if (this.panel.log && point.y <= 0) continue;
        const px = x(point.at), py = y(point.y);
        pen.lineTo(px, py);
        this.drawn.push({point, curve: i, px, py});
      }
      pen.stroke();
      pen.setLineDash([]);
      pen.globalAlpha = 1;
      if (points.length > WHISKERS) return;
      pen.beginPath();
      for (const {at, y: value, half} of points) {
        if (!half) continue;
        pen.moveTo(x(at), y(value - half));
        pen.lineTo(x(at), y(value + half));
        for (const end of [value - half, value + half]) {
          pen.moveTo(x(at) - 3, y(end));
          pen.lineTo(x(at) + 3, y(end));
        }
      }
      pen.stroke();
    }

    points(pen) {
      const bad = colour('--bad'), ground = colour('--ground');
      const size = this.drawn.length > 600 ? 2 : 3.2;
      const ordered = this.drawn.filter(({point}) => !faulty(point)).concat(this.drawn.filter(({point}) => faulty(point)));
      for (const {point, curve, px, py} of ordered) {
        pen.beginPath();
        if (faulty(point)) {
          pen.moveTo(px, py - 1.7 * size);
          pen.lineTo(px + 1.5 * size, py + size);
          pen.lineTo(px - 1.5 * size, py + size);
          pen.closePath();
        } else {
          pen.arc(px, py, size, 0, 2 * Math.PI);
        }
        pen.fillStyle = faulty(point) ? bad : colour('--pen' + curve % PENS);
        pen.fill();
        if (size > 3) {
          pen.strokeStyle = ground;
          pen.lineWidth = 0.8;
          pen.stroke();
        }
        if (point !== this.point || curve !== this.curve) continue;
        pen.strokeStyle = colour('--ink');
        pen.lineWidth = 2;
        pen.beginPath();
        pen.arc(px, py, 8, 0, 2 * Math.PI);
        pen.stroke();
      }
    }

    axes(pen, {x, y, low, high, right, bottom}) {
      pen.font = '12px system-ui, sans-serif';
      pen.fillStyle = colour('--soft');
      pen.strokeStyle = colour('--grid');
      pen.lineWidth = 1;
      pen.textAlign = 'right';
      pen.textBaseline = 'middle';
      for (const value of ticks(low, high, this.panel.log)) {
        pen.beginPath();
        pen.moveTo(LEFT, y(value));
        pen.lineTo(right, y(value));
        pen.stroke();
        pen.fillText(short(value), LEFT - 6, y(value));
      }
      pen.textAlign = 'center';
      pen.textBaseline = 'top';
      const [from, to] = this.group.range;
      const each = Math.max(1, Math.round(step(to - from, Math.max(2, (right - LEFT) / 90))));
      for (let at = Math.ceil(from / each) * each; at <= to; at += each)
        if (at >= 1) pen.fillText(String(at), Math.min(x(at), right - 8), bottom + 6);
      pen.strokeStyle = colour('--line');
      pen.strokeRect(LEFT, TOP, right - LEFT, bottom - TOP);
    }
  }

  return {Plot};
})();
