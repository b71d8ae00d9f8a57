// SPDX-License-Identifier: MIT
// What the plots of trends show: curves of points, one a judged log. A point is {at, row, y, half}: place among
// the judged logs, its row, the value and half of its 95 % interval (0: none).
'use strict';
const faultlineTrends = (() => {
  const {data, rows} = faultlineIndex;
  const MOST_FOLDERS = 200;  // of more, no reader finds one in the legend; the table of folders has them
  const judged = [];

  // To be called once, when all rows are there.
  function judge() {
    judged.push(...rows.filter((row) => row.verdict === 'healthy' || row.verdict === 'faulty'));
    if (data.time) judged.sort((a, b) => a.start - b.start || a.no - b.no);
    judged.forEach((row, i) => { row.at = i + 1; });
  }

  function curve(name, value) {
    const points = [];
    for (const row of judged) {
      const [y, half] = value(row);
      if (y !== null && isFinite(y)) points.push({at: row.at, row, y, half: half || 0});
    }
    return {name, points};
  }

  function median(values) {
    return values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
  }

  function residuals() {
    const joints = judged.reduce((most, row) => Math.max(most, row.part.rms.length), 0);
    return Array.from({length: joints}, (_, j) =>
      curve('joint ' + (j + 1), (row) => [j < row.part.rms.length ? row.part.rms[j][row.i] : null]));
  }

  function groups(of, name) {
    const members = new Map();
    for (const row of judged) {
      if (!members.has(of(row))) members.set(of(row), []);
      members.get(of(row)).push(row);
    }
    return Array.from(members, ([key, list]) => ({
      name: name(key), points: list.filter((row) => row.residual !== null)
        .map((row) => ({at: row.at, row, y: row.residual, half: 0})),
    }));
  }

  // Names of values in the columns of a part, of all judged logs.
  const namesIn = (list) => [...new Set(Array.from(new Set(judged.map((row) => row.part)))
    .flatMap((part) => Object.keys(part[list])))];

  // Named values of the judged logs, by name; `level` makes a curve of the name and all its values.
  function shares(list, level, wanted) {
    return namesIn(list).filter(wanted).map((name) => {
      const all = [];
      for (const row of judged) {
        const columns = row.part[list][name];
        if (columns && columns[0][row.i] !== null)
          all.push({row, value: columns[0][row.i], half: columns[1][row.i]});
      }
      return level(data.parameters[name], all);
    }).filter((curve) => curve.points.length);
  }

  const isFriction = (index) => /^friction_\d+$/.test(data.parameters[index]);

  function friction() {
    return shares('condition', (name, all) => ({
      name: 'joint ' + name.split('_').pop(),
      points: all.map(({row, value, half}) => ({at: row.at, row, y: value, half: half || 0})),
    }), isFriction);
  }

  // From the median of the logs of the same model; those near zero have no such share.
  function parameters() {
    return shares('parameters', (name, all) => {
      const clear = all.filter(({value, half}) => half !== null && Math.abs(value) > 1.5 * half);
      const usual = new Map();
      for (const model of new Set(clear.map(({row}) => row.model))) {
        const own = clear.filter(({row}) => row.model === model).map(({value}) => value);
        if (own.length > 1) usual.set(model, median(own));
      }
      const points = all.filter(({row}) => usual.has(row.model)).map(({row, value, half}) => {
        const scale = 100 / usual.get(row.model);
        return {at: row.at, row, y: scale * value - 100, half: Math.abs(scale * (half || 0))};
      });
      return {name, points};
    }, () => true);
  }

  // Curves are made when their panel comes into sight.
  function panels() {
    const several = (of, most) => {
      const keys = new Set(judged.map(of));
      return keys.size > 1 && keys.size <= most;
    };
    const named = (list, wanted) => namesIn(list).filter(wanted).some((name) =>
      judged.some((row) => row.part[list][name] && row.part[list][name][0][row.i] !== null));
    const model = (row) => row.model, folder = (row) => row.folder;
    const all = [
      {title: 'Residual (1 as in healthy logs)', log: true, has: judged.some((row) => row.residual !== null), make: residuals},
      {title: 'Residual by robot (model)', log: true, has: several(model, Infinity),
       make: () => groups(model, (key) => data.models[key] || '-')},
      {title: 'Residual by folder', log: true, has: several(folder, MOST_FOLDERS),
       make: () => groups(folder, (key) => key || '(files)')},
      {title: 'Faults', zero: true, has: true, make: () => [curve('faults', (row) => [row.faults.length])]},
      {title: 'Friction, % from identified', make: friction,
       has: named('condition', isFriction)},
      {title: 'Parameters, % from their median', has: named('parameters', () => true), make: parameters},
    ];
    return judged.length < 2 ? [] : all.filter((panel) => panel.has);
  }

  return {judge, judged, panels};
})();
