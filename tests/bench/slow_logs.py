#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Logs of 10 to 20 rows a second: robots drawn at random, whose masses, friction and controller differ by day.

Usage: slow_logs.py [PERIOD_S...]     called by slow_logs.sh
"""
import math
import os
import random
import sys

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "slow-logs")
SEED = int(os.environ.get("SEED", "1"))
PERIODS_S = (0.05, 0.073, 0.1)
LEARNED_DAYS, HEALTHY_DAYS, REPEATS = 5, 8, 2
MASS_BY_DAY, FRICTION_BY_DAY = 0.004, 0.05  # standard deviations, relative
DURATION_S = 25.0

# Sizes are drawn from the range; those of joint 3, a slide, are multiplied by the last number.
FAULTS = {
    "free_swinging": None,
    "locked": None,
    "torque_loss": (0.2, 0.7, 1.0),
    "sensor_bias": (0.01, 0.08, 0.2),
    "stuck_encoder": None,
    "sensor_drift": (0.01, 0.08, 0.2),
    "friction_increase": (0.5, 2.0, 2.0),
    "payload_change": (0.1, 0.4, 1.0),
    "collision": (6.0, 20.0, 1.0),
    "torque_sensor_error": (1.5, 5.0, 1.0),
}


class Cell:
    """A robot, and how its days differ."""

    def __init__(self, period_s):
        self.rng = random.Random(f"{SEED} {period_s}")
        self.period_s = period_s
        draw = self.rng.uniform
        self.masses = [draw(0.8, 1.5), draw(0.6, 1.0), draw(0.4, 0.6)]
        self.length = [draw(0.8, 1.0), draw(0.6, 0.8)]
        self.viscous = [draw(0.3, 0.6), draw(0.2, 0.4), draw(1.0, 2.0)]
        self.coulomb = [draw(0.4, 0.7), draw(0.3, 0.5), draw(0.7, 1.2)]

    def spec(self, seed, name, fault):
        day = lambda values, std: [v * (1.0 + self.rng.gauss(0.0, std)) for v in values]
        m1, m2, m3 = day(self.masses, MASS_BY_DAY)
        by_day = [1.0 + self.rng.gauss(0.0, FRICTION_BY_DAY) for _ in range(3)]
        viscous = [v * f for v, f in zip(self.viscous, by_day)]
        coulomb = [c * f for c, f in zip(self.coulomb, by_day)]
        return f"""format = "csv"
seed = {seed}
duration_s = {DURATION_S}
sample_period_s = {self.period_s}
control_period_s = "held"
noise = {{q = [3e-4, 3e-4, 1e-4], dq = [3e-3, 3e-3, 1e-3]}}
limits = {{stop_low = [-1e9, -1e9, -0.45], stop_high = [1e9, 1e9, 0.15], overspeed = [12, 12, 4]}}
controller = {{mass_error_std = 0.02}}

[motion]
profile = "quintic"
low = [-2.0, -2.0, -0.35]
high = [2.0, 2.0, 0.05]
move_s = [1.2, 1.8]
dwell_s = [0.2, 0.6]

[robot]
name = "slow"
axes = "RRP"
known = {{m1 = {m1}, m2 = {m2}, m3 = {m3}, l1 = {self.length[0]}, l2 = {self.length[1]}}}
friction = {{viscous = {viscous}, coulomb = {coulomb}, width = [0.02, 0.02, 0.01]}}

[[run]]
name = "{name}"
{fault}
"""

    def log(self, folder, seed, name, fault=""):
        folder = os.path.join(folder, name)
        os.makedirs(folder, exist_ok=True)
        spec = os.path.join(folder, "spec.toml")
        with open(spec, "w") as file:
            file.write(self.spec(seed, name, fault))
        simulated.run("simulate", spec, "-o", folder)
        return os.path.join(folder, name + ".csv")

    def fault(self, kind, joint):
        """Its onset and the spec's text."""
        onset = self.rng.uniform(5.0, 16.0)
        text = f'fault = {{kind = "{kind}", joint = {joint}, onset_s = {onset:.4f}'
        if FAULTS[kind]:
            low, high, of_slide = FAULTS[kind]
            text += f", size = {self.rng.uniform(low, high) * (of_slide if joint == 3 else 1.0):.4f}"
        if kind == "collision":
            text += f", duration_s = {self.rng.uniform(0.08, 0.3):.4f}"
        return onset, text + "}"


def judge(period_s, seed):
    """The line of the table, and what went wrong."""
    cell, folder = Cell(period_s), os.path.join(OUT, f"{round(1000 * period_s)}ms")
    days = [cell.log(folder, seed + i, f"day_{i}") for i in range(LEARNED_DAYS)]
    model, _ = simulated.learn_from(days, folder, cell.length[0], held=True)
    runs, paths = [], []
    for i in range(HEALTHY_DAYS):
        runs.append((f"healthy_{i}", "none", 0, math.inf))
        paths.append(cell.log(folder, seed + 100 + i, runs[-1][0]))
    for kind in FAULTS:
        for joint in (3,) if kind == "payload_change" else (1, 2, 3):
            for i in range(REPEATS):
                onset, text = cell.fault(kind, joint)
                runs.append((f"{kind}_{joint}_{i}", kind, joint, onset))
                paths.append(cell.log(folder, seed + 200 + len(runs), runs[-1][0], text))
    name = f"{1000 * period_s:g} ms"
    tally, notes = simulated.tally_of(name, runs, paths, model)
    return tally.line(name), notes


def main(wanted):
    print("| sample period | with alarm | inconclusive | with a fault: found | right | early | median delay/s |")
    print("|---|---|---|---|---|---|---|")
    notes = []
    for i, period_s in enumerate([float(p) for p in wanted] or PERIODS_S):
        line, wrong = judge(period_s, 1000 * SEED + 10000 * (i + 1))
        print(line, flush=True)
        notes += wrong
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
