// SPDX-License-Identifier: MIT
// Puts interactive plots where the page has pictures, when they come into sight, and lets the timeline zoom them.
// Without script, or when it fails, the pictures stay.
'use strict';
(() => {
  const {data} = faultlineSeries;
  const {Group, Plot} = faultlinePlots;
  const groups = new Map();

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
    const group = groups.get(figure.group);
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

  // The plots of a fault, and its evidence, which zooms alone.
  function groupsOf(fault) {
    return [groups.get(fault), fault ? groups.get(-fault) : undefined].filter(Boolean);
  }

  function addTools(place) {
    const fault = Number(place.dataset.fault);
    const add = (text, label, action) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = text;
      if (label !== text) button.setAttribute('aria-label', label);
      button.addEventListener('click', () => groupsOf(fault).forEach(action));
      place.append(button);
    };
    add('Reset zoom', 'Reset zoom', (group) => group.reset());
    add('+', 'Zoom in', (group) => group.scale(0.5));
    add('\u2212', 'Zoom out', (group) => group.scale(2));
    add('\u2190', 'Earlier', (group) => group.pan(-0.2));
    add('\u2192', 'Later', (group) => group.pan(0.2));
    const help = document.createElement('span');
    help.className = 'help';
    help.textContent = 'Drag to zoom, shift and drag to move, double click to reset; keys: arrows, +, -, Escape.';
    place.append(help);
  }

  for (const figure of data.figures) {
    if (!groups.has(figure.group))
      groups.set(figure.group, new Group(data.figures.filter((f) => f.group === figure.group)));
    waiting.set(document.getElementById(figure.id), figure);
  }
  for (const place of document.querySelectorAll('.tools')) addTools(place);
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
      for (const group of groupsOf(fault)) group.reset();
    });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    for (const group of groups.values()) for (const plot of group.plots) plot.recolour();
  });
})();
