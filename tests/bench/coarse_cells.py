#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cells whose logs are coarse: codes, velocities by difference, stamps that wobble, rows lost, other days.

Usage: coarse_cells.py [CELL...]     called by coarse_cells.sh
"""
import math
import os
import random
import sys

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "coarse-cells")
DAYS = 6
LOG_PERIOD_S = 0.002
LOST = 0.005
CODES = [2 * math.pi / 2**16, 2 * math.pi / 2**16, 2e-5]

# cell: period of the controller, standard deviation of the stamps
CELLS = {
    "steady": (0.002, 4e-4),        # one row each period of the controller
    "fast_control": (0.001, 2.5e-4),  # every second one is logged, dq from one to the next
}
SIZES = (1.0, 0.6)
FAULTS = dict(simulated.FAULTS, stuck_encoder=([0, 0, 0], ""))


class Day:
    """Friction and torque constants of a day, and how its log is written."""

    def __init__(self, rng, wobble_s):
        self.friction = rng.uniform(0.75, 1.3)
        self.torque_constant = [rng.uniform(0.98, 1.02) for _ in range(3)]
        self.wobble_s = wobble_s

    def write(self, head, rows, rng):
        for j in (1, 2, 3):
            q, dq, tau = (simulated.column(head, f"{name}{j}") for name in ("q", "dq", "tau"))
            codes = [round(float(row[q]) / CODES[j - 1]) * CODES[j - 1] for row in rows]
            for k, row in enumerate(rows):
                row[q] = repr(codes[k])
                row[dq] = repr((codes[k] - codes[max(k - 1, 0)]) / simulated.PERIOD_S)
                row[tau] = repr(float(row[tau]) / self.torque_constant[j - 1])
        rows = rows[:: round(LOG_PERIOD_S / simulated.PERIOD_S)]
        kept, last = [], -1.0
        for row in rows:
            stamp = round(float(row[0]) + rng.gauss(0.0, self.wobble_s), 3)
            if rng.random() < LOST or stamp <= last:
                continue
            last = stamp
            kept.append([f"{stamp:.3f}"] + row[1:])
        return kept


def faulty_runs():
    """(name, kind, joint, onset) and the spec's text of each."""
    runs = []
    for kind, (sizes, more) in FAULTS.items():
        for joint in (1, 2, 3):
            for i, share in enumerate(SIZES):
                if kind == "payload_change" and joint < 3:
                    continue
                onset = 3.1 + 0.7 * i + 0.1 * joint
                text = f'fault = {{kind = "{kind}", joint = {joint}, onset_s = {onset}'
                if sizes[joint - 1]:
                    text += f", size = {share * sizes[joint - 1]}"
                runs.append(((f"{kind}_{joint}_{i}", kind, joint, onset), text + more + "}"))
    return runs


def simulate(folder, seed, runs, wobble_s):
    rng, paths = random.Random(seed), []
    for i, (name, text) in enumerate(runs):
        day = Day(rng, wobble_s)
        row = simulated.Row(friction=day.friction, change=day.write)
        simulated.simulate(os.path.join(folder, name), row, 1000 * seed + i, [((name, "", 0), text)])
        paths.append(os.path.join(folder, name, name + ".csv"))
    return paths


def learn(folder, seed, wobble_s):
    logs = simulate(os.path.join(folder, "learn"), seed, [(f"day_{i}", "") for i in range(DAYS)], wobble_s)
    return simulated.learn_from(logs, folder)[0]


def judge(name, seed):
    """The cell's line of the table, and what went wrong."""
    simulated.PERIOD_S, wobble_s = CELLS[name]
    folder = os.path.join(OUT, name)
    model = learn(folder, seed, wobble_s)
    healthy = [((f"healthy_{i}", "none", 0, math.inf), "") for i in range(DAYS)]
    runs = healthy + faulty_runs()
    paths = simulate(os.path.join(folder, "test"), seed + 1, [(run[0][0], run[1]) for run in runs], wobble_s)
    tally, notes = simulated.tally_of(name, [run[0] for run in runs], paths, model)
    return tally.line(name), notes


def main(wanted):
    unknown = [name for name in wanted if name not in CELLS]
    if unknown:
        sys.exit(f"coarse_cells: no cell {unknown[0]}; expected one of {', '.join(CELLS)}")
    simulated.DURATION_S = 8.0
    simulated.MASSES = {"m1": 7.0, "m2": 5.0, "m3": 1.6}
    simulated.VISCOUS, simulated.COULOMB = [1.8, 0.9, 12.0], [2.5, 1.6, 5.0]
    simulated.Q_NOISE = [1e-5, 1e-5, 2e-6]
    print("| cell | with alarm | inconclusive | with a fault: found | right | early | median delay/s |")
    print("|---|---|---|---|---|---|---|")
    notes = []
    for i, name in enumerate(CELLS):
        if not wanted or name in wanted:
            line, wrong = judge(name, 11 + 10 * i)
            print(line, flush=True)
            notes += wrong
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
