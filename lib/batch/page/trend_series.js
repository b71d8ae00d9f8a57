// SPDX-License-Identifier: MIT
// What the plots of trends show: curves of points, one a judged log. A point is {at, row, y, half}: place among
// the judged logs, its row, the value and half of its 95 % interval (0: none).
'use strict';
const faultlineTrends = (() => {
  const {data, rows} = faultlineIndex;
  const judged = rows.filter((row) => row.verdict === 'healthy' || row.verdict === 'faulty');
  if (data.time) judged.sort((a, b) => a.start - b.start || a.no - b.no);
  judged.forEach((row, i) => { row.at = i + 1; });

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
    const joints = Math.max(0, ...judged.slice(0, 1e5).map((row) => row.rms.length));
    return Array.from({length: joints}, (_, j) =>
      curve('joint ' + (j + 1), (row) => [row.rms[j] === undefined ? null : row.rms[j]]));
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

  // [name, value, half of the interval] lists of rows, by name; `level` tells what 100 % is, for names and models.
  function shares(list, level, wanted) {
    const values = new Map();
    for (const row of judged)
      for (const [name, value, half] of row[list]) {
        if (!wanted(name)) continue;
        if (!values.has(name)) values.set(name, []);
        values.get(name).push({row, value, half});
      }
    return Array.from(values, ([name, all]) => level(data.parameters[name], all)).filter((c) => c.points.length);
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
    const several = (of) => judged.some((row) => of(row) !== of(judged[0]));
    const model = (row) => row.model, folder = (row) => row.folder;
    const all = [
      {title: 'Residual (1 as in healthy logs)', log: true, has: judged.some((row) => row.rms.length), make: residuals},
      {title: 'Residual by robot (model)', log: true, has: several(model),
       make: () => groups(model, (key) => data.models[key] || '-')},
      {title: 'Residual by folder', log: true, has: several(folder), make: () => groups(folder, (key) => key || '(files)')},
      {title: 'Faults', zero: true, has: true, make: () => [curve('faults', (row) => [row.faults.length])]},
      {title: 'Friction, % from identified', make: friction,
       has: judged.some((row) => row.condition.some(([name]) => isFriction(name)))},
      {title: 'Parameters, % from their median', has: judged.some((row) => row.parameters.length), make: parameters},
    ];
    return judged.length < 2 ? [] : all.filter((panel) => panel.has);
  }

  return {judged, panels};
})();
