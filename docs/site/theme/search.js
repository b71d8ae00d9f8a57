// SPDX-License-Identifier: MIT
// Lists the sections that contain every word of ?q=... The build writes searchIndex from all pages.
'use strict';
(() => {
  const MOST_RESULTS = 40, EXCERPT = 220, BEFORE = 60;
  const IN_TITLE = 100, IN_ORDER = 50, WHOLE_WORD = 20, MOST_COUNTED = 10;  // points of a match

  const wordsOf = (text) => text.toLowerCase().split(/[^\p{L}\p{N}_.-]+/u).filter(Boolean);

  function count(text, word) {
    return Math.min(text.split(word).length - 1, MOST_COUNTED);
  }

  // How well a section answers; 0 where it lacks a word.
  function score(section, words) {
    const title = section.title.toLowerCase(), text = section.text.toLowerCase();
    const known = new Set(wordsOf(title + ' ' + text));
    let sum = (title + ' ' + text).includes(words.join(' ')) ? IN_ORDER : 0;
    for (const word of words) {
      const found = (title.includes(word) ? IN_TITLE : 0) + count(text, word);
      if (found === 0) return 0;
      sum += found + (known.has(word) ? WHOLE_WORD : 0);
    }
    return sum;
  }

  // The stretch of a text that has most of the words.
  function excerpt(text, words) {
    const lower = text.toLowerCase();
    let begin = 0, most = 0;
    for (const word of words)
      for (let at = lower.indexOf(word), seen = 0; at >= 0 && seen < MOST_COUNTED; at = lower.indexOf(word, at + 1), ++seen) {
        const start = Math.max(0, at - BEFORE), part = lower.slice(start, start + EXCERPT);
        const has = words.filter((other) => part.includes(other)).length + (part.includes(words.join(' ')) ? 1 : 0);
        if (has > most) [begin, most] = [start, has];
      }
    return (begin > 0 ? '... ' : '') + text.slice(begin, begin + EXCERPT) +
      (begin + EXCERPT < text.length ? ' ...' : '');
  }

  // The text with the words marked, without reading it as HTML.
  function marked(text, words) {
    const line = document.createElement('p'), lower = text.toLowerCase();
    for (let at = 0; at < text.length;) {
      const next = words.map((word) => [lower.indexOf(word, at), word]).filter(([i]) => i >= 0)
        .sort((a, b) => a[0] - b[0] || b[1].length - a[1].length)[0];
      line.append(text.slice(at, next ? next[0] : text.length));
      if (!next) break;
      line.appendChild(document.createElement('mark')).textContent = text.slice(next[0], next[0] + next[1].length);
      at = next[0] + next[1].length;
    }
    return line;
  }

  function entry(section, words) {
    const item = document.createElement('li'), link = item.appendChild(document.createElement('a'));
    link.href = section.location;
    link.textContent = section.page === section.title ? section.title : section.page + ': ' + section.title;
    item.append(marked(excerpt(section.text, words), words));
    return item;
  }

  const pageOf = (section) => section.location.split('#')[0];

  // Sections by how well they answer; a whole page only where none of its sections has all words.
  function search(sections, words) {
    const title = new Map(sections.filter((s) => s.location === pageOf(s)).map((s) => [s.location, s.title]));
    const found = sections.map((s) => ({...s, page: title.get(pageOf(s)) || s.title, points: score(s, words)}))
      .filter((s) => s.points > 0);
    const answered = new Set(found.filter((s) => s.location !== pageOf(s)).map(pageOf));
    return found.filter((s) => s.location !== pageOf(s) || !answered.has(s.location))
      .sort((a, b) => b.points - a.points);
  }

  function summary(count, words) {
    if (words.length === 0) return 'Write what you look for into the search field.';
    const all = count === 1 ? '1 section has all these words' : count + ' sections have all these words';
    return count > MOST_RESULTS ? all + '; the best ' + MOST_RESULTS + ' are:' : count > 0 ? all + ':' : all + '.';
  }

  const query = new URLSearchParams(location.search).get('q') || '', words = wordsOf(query);
  const found = words.length === 0 ? [] : search(searchIndex.docs, words);
  document.querySelector('input[type=search]').value = query;
  document.querySelector('#count').textContent = summary(found.length, words);
  document.querySelector('#results').append(...found.slice(0, MOST_RESULTS).map((s) => entry(s, words)));
})();
