#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether the smallest fault that a model says it finds is found: faults of a half, once and twice that size.

Usage: least_found.py [CELL...]     called by least_found.sh; cells of own_cells.py, or a period in s of slow_logs.py
"""
import json
import os
import random
import sys

import healthy_but_different as simulated
import own_cells
import slow_logs

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "least-found")
SEED = int(os.environ.get("SEED", "1"))
CELLS = ("springs", "sticky", "wobbly", "0.05", "0.073")
FACTORS = (0.5, 1.0, 2.0)
REPEATS = 3
DAYS = 6
PUSH_S = 0.1  # as the model takes it


class OwnCell:
    """A robot of own_cells.py."""

    duration_s = own_cells.DURATION_S

    def __init__(self, name, folder):
        self.cell, self.folder = own_cells.CELLS[name], folder
        self.robot = own_cells.Robot(random.Random(f"{name} {SEED}"))

    def logs(self, name, seed, runs):
        return own_cells.simulate(os.path.join(self.folder, name), self.robot, self.cell, seed, runs)

    def l1(self):
        return self.robot.l[0]

    held = False


class SlowCell:
    """A robot of slow_logs.py."""

    duration_s = slow_logs.DURATION_S

    def __init__(self, name, folder):
        self.cell, self.folder = slow_logs.Cell(float(name)), folder

    def logs(self, name, seed, runs):
        folder = os.path.join(self.folder, name)
        return [self.cell.log(folder, seed + i, *run) for i, run in enumerate(runs)]

    def l1(self):
        return self.cell.length[0]

    held = True


def fault_text(label, size, onset_s):
    text = f'fault = {{kind = "{label["kind"]}", joint = {label["joint"]}, onset_s = {onset_s:.4f}, size = {size:.6g}'
    return text + (f", duration_s = {PUSH_S}}}" if label["kind"] == "collision" else "}")


def simulated_size(label, factor):
    size = factor * label["size"]
    return size / PUSH_S if label["kind"] == "collision" else size  # an impulse; the simulator takes the force


def is_found(report, onset_s):
    faults = report["faults"] + report.get("small_changes", [])
    return any(fault.get("alarm_s", fault["onset_s"]) >= onset_s - 0.05 for fault in faults)


def judge(name, seed):
    """By factor and kind: how many were found of how many."""
    folder = os.path.join(OUT, f"{name}_{SEED}")
    cell = (OwnCell if name in own_cells.CELLS else SlowCell)(name, folder)
    days = cell.logs("learn", seed, [(f"day_{i}", "") for i in range(DAYS)])
    model, _ = simulated.learn_from(days, folder, cell.l1(), held=cell.held)
    with open(model) as file:
        labels = [each for each in json.load(file)["validation"]["reach"] if each["size"] is not None]
    onset_s = 0.5 * cell.duration_s
    runs = [(f'{label["kind"]}_{label["joint"]}_{factor}_{i}', fault_text(label, simulated_size(label, factor), onset_s))
            for label in labels for factor in FACTORS for i in range(REPEATS)]
    paths = cell.logs("test", seed + 1000, runs)
    reports = simulated.diagnose_all(paths, model)
    found = {}
    of = [(label, factor) for label in labels for factor in FACTORS for i in range(REPEATS)]
    for (label, factor), report in zip(of, reports):
        tally = found.setdefault(label["kind"], {}).setdefault(factor, [0, 0])
        tally[0] += is_found(report, onset_s)
        tally[1] += 1
    return found


def line(name, tallies):
    return f"| {name} | " + " | ".join(f"{tallies[f][0]} of {tallies[f][1]}" for f in FACTORS) + " |"


def main(wanted):
    print("| cell, kind | half the size | the size | twice the size |\n|---|---|---|---|")
    total = {f: [0, 0] for f in FACTORS}
    for i, name in enumerate(wanted or CELLS):
        found = judge(name, 100000 * SEED + 5000 * i)
        for kind, tallies in found.items():
            print(line(f"{name}, {kind}", tallies), flush=True)
            for f in FACTORS:
                total[f] = [total[f][0] + tallies[f][0], total[f][1] + tallies[f][1]]
    print(line("all", total))


if __name__ == "__main__":
    main(sys.argv[1:])
