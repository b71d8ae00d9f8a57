// SPDX-License-Identifier: MIT
// What pages must keep so that they can be read on a phone, in the dark and by assistive technology (WCAG 2,
// levels A and AA, as far as a script can tell). pageViolations() lists what breaks a rule; pageFacts() is the
// layout in words.
'use strict';
(() => {
  const TEXT = 4.5, LARGE_TEXT = 3, GRAPHICS = 3, TARGET = 24;

  function parts(colour) { return (colour.match(/[\d.]+/g) || []).map(Number); }

  function luminance(colour) {
    const [r, g, b] = parts(colour).map((x) => x / 255)
      .map((x) => (x <= 0.03928 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4)));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  }

  function contrast(one, other) {
    const a = luminance(one), b = luminance(other);
    return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  }

  // A custom property as the browser computes colours.
  function variable(name) {
    const probe = document.body.appendChild(document.createElement('i'));
    probe.style.color = 'var(' + name + ')';
    const colour = getComputedStyle(probe).color;
    probe.remove();
    return colour;
  }

  function shown(element) {
    const box = element.getBoundingClientRect();
    return box.width > 0 && box.height > 0 && element.checkVisibility({visibilityProperty: true});
  }

  function ground(element) {
    if (element.classList.contains('number'))
      return getComputedStyle(element.parentNode.querySelector('.fault')).fill;
    for (let e = element; e; e = e.parentElement) {
      const colour = getComputedStyle(e).backgroundColor;
      if (parts(colour)[3] !== 0) return colour;
    }
    return 'rgb(255, 255, 255)';
  }

  function named(element) {
    for (let e = element; e; e = e.parentElement) if (e.getAttribute('aria-hidden') === 'true') return true;
    const name = element.getAttribute('aria-label') || element.querySelector('title');
    return element.hasAttribute('role') && Boolean(name);
  }

  function where(element) {
    const name = (' ' + (element.getAttribute('class') || '')).trimEnd().replaceAll(' ', '.');
    return element.tagName.toLowerCase() + name + ' "' + element.textContent.trim().slice(0, 40) + '"';
  }

  function documentRules(say) {
    const root = document.documentElement;
    if (!root.lang) say('the page has no language');
    if (!document.title.trim()) say('the page has no title');
    if (document.querySelectorAll('main').length !== 1) say('not one main landmark');
    if (document.querySelectorAll('h1').length !== 1) say('not one h1');
    if (root.scrollWidth > innerWidth) say('the page scrolls sideways: ' + root.scrollWidth + ' of ' + innerWidth);
    let level = 0;
    for (const heading of document.querySelectorAll('h1, h2, h3, h4, h5, h6')) {
      const now = Number(heading.tagName[1]);
      if (!heading.textContent.trim()) say('an empty heading');
      if (now > level + 1) say('a heading skips a level: ' + where(heading));
      level = now;
    }
  }

  function textRules(say) {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const seen = new Set();
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const element = node.parentElement;
      if (!node.data.trim() || seen.has(element) || element.closest('script, style, .unseen')) continue;
      if (!shown(element)) continue;
      seen.add(element);
      const style = getComputedStyle(element), size = parseFloat(style.fontSize);
      const colour = element instanceof SVGElement ? style.fill : style.color;
      const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
      const found = contrast(colour, ground(element));
      if (!(found >= (large ? LARGE_TEXT : TEXT))) say('contrast ' + found.toFixed(2) + ': ' + where(element));
    }
  }

  function graphicsRules(say) {
    for (const element of document.querySelectorAll('svg, canvas, .live'))
      if (shown(element) && !named(element)) say('a picture without role or name: ' + where(element));
    const page = getComputedStyle(document.body).backgroundColor;
    for (const name of ['--axis', '--lane', '--bad', '--pen0', '--pen1', '--pen2', '--pen3', '--pen4', '--pen5'])
      if (!(contrast(variable(name), page) >= GRAPHICS)) say(name + ' is hard to see');
    for (const legend of document.querySelectorAll('.legend')) {
      const looks = [...legend.querySelectorAll('svg')]
        .map((s) => s.innerHTML.replace(/(stroke|fill)="#[^"]*"/g, ''));
      if (new Set(looks).size < looks.length) say('only colour tells lines apart: ' + where(legend));
    }
    for (const fault of document.querySelectorAll('.timeline a')) {
      const heights = ['.before', '.fault'].map((part) => fault.querySelector(part).getAttribute('height'));
      if (heights[0] === heights[1]) say('only colour tells what is before the alarm: ' + where(fault));
    }
    for (const link of document.querySelectorAll('a:not(svg a, .button)'))
      if (!getComputedStyle(link).textDecorationLine.includes('underline'))
        say('only colour tells a link: ' + where(link));
  }

  function tableRules(say) {
    for (const table of document.querySelectorAll('table')) {
      if (!table.caption || !table.caption.textContent.trim()) say('a table without caption: ' + where(table));
      for (const head of table.querySelectorAll('th'))
        if (!head.scope || !head.textContent.trim()) say('a heading of cells without scope or words: ' + where(head));
    }
  }

  function scrolls(element) {
    const style = getComputedStyle(element);
    return (/auto|scroll/.test(style.overflowX) && element.scrollWidth > element.clientWidth + 1) ||
      (/auto|scroll/.test(style.overflowY) && element.scrollHeight > element.clientHeight + 1);
  }

  function controlRules(say) {
    for (const field of document.querySelectorAll('input, select, textarea'))
      if (shown(field) && !field.labels.length && !field.getAttribute('aria-label')) say('a field without label: ' + where(field));
    for (const button of document.querySelectorAll('button'))
      if (!(button.getAttribute('aria-label') || button.textContent).trim()) say('a button without name');
    for (const element of document.querySelectorAll('body *'))
      if (shown(element) && scrolls(element) && element.tabIndex < 0) say('not scrolled by keys: ' + where(element));
    for (const element of document.querySelectorAll('a, button, summary, input, select')) {
      const box = element.getBoundingClientRect();
      if (shown(element) && (box.width < TARGET || box.height < TARGET))
        say('a target of ' + box.width.toFixed(1) + ' x ' + box.height.toFixed(1) + ': ' + where(element));
    }
    for (const plot of document.querySelectorAll('.live'))
      if (shown(plot) && plot.tabIndex !== 0) say('a plot that keys do not reach');
    for (const bar of document.querySelectorAll('.tools'))
      if (document.querySelector('.drawn') && bar.querySelectorAll('button').length < 5)
        say('plots without buttons');
  }

  window.pageViolations = () => {
    const found = [];
    for (const rule of [documentRules, textRules, graphicsRules, tableRules, controlRules])
      rule((what) => found.push(what));
    return found;
  };

  // Numbers do not depend on the fonts of a machine: widths in tens of px, what style decides, colours.
  window.pageFacts = () => {
    const rough = (x) => 10 * Math.round(x / 10);
    const style = (selector, name) => getComputedStyle(document.querySelector(selector))[name];
    const lefts = [...document.querySelectorAll('main > div > .plots > figure')]
      .map((f) => Math.round(f.getBoundingClientRect().left));
    const plot = document.querySelector('.live').getBoundingClientRect();
    const timeline = document.querySelector('.timeline svg').getBoundingClientRect();
    return [
      'page ' + rough(document.documentElement.scrollWidth) + ' of ' + innerWidth,
      'plots side by side ' + new Set(lefts).size + ', one ' + rough(plot.width) + ' x ' + rough(plot.height),
      'timeline to ' + rough(timeline.right) + ', ' + rough(timeline.height) + ' high, text ' +
        style('.timeline', 'fontSize'),
      'ticks ' + [...document.querySelectorAll('.timeline .tick')].filter(shown).length,
      'rows of faults as ' + style('#faults tr', 'display'),
      'buttons ' + style('.tools', 'position'),
      'ground ' + style('body', 'backgroundColor') + ', text ' + style('body', 'color'),
      'axis ' + variable('--axis') + ', its words ' + style('.live .dygraph-axis-label', 'color'),
      'fault ' + style('.timeline .fault', 'fill') + ', lane ' + style('.timeline .lane', 'fill'),
      'curves ' + [0, 1, 2, 3, 4, 5].map((i) => variable('--pen' + i)).join(' '),
    ];
  };
})();
