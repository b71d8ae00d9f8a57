#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Faults that come and go, on the cells of robots drawn at random whose days differ.

Usage: loose_contacts.py     called by loose_contacts.sh; SEED in the environment draws other robots
"""
import os
import random

import healthy_but_different as simulated
import own_cells

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "loose-contacts")
DURATION_S = own_cells.DURATION_S
KINDS = ("torque_loss", "friction_increase", "sensor_bias")
# from when to when the fault is there; to the end of the log where it stays
PATTERNS = {
    "stays": [(3.0, DURATION_S)],
    "comes twice, 1.5 s each": [(3.0, 4.5), (6.0, 7.5)],
    "is gone for 1.5 s": [(3.0, 5.0), (6.5, DURATION_S)],
    "comes four times, .6 s each": [(2.5, 3.1), (4.3, 4.9), (6.1, 6.7), (7.9, 8.5)],
}
NEAR_S = 0.5


def faults_text(robot, kind, joint, spans):
    size = own_cells.FAULTS[kind][joint - 1] * (robot.rating[joint - 1] if kind in own_cells.OF_RATING else 1.0)
    text = ""
    for onset_s, end_s in spans:
        text += f'[[run.fault]]\nkind = "{kind}"\njoint = {joint}\nonset_s = {onset_s + 0.0137}\nsize = {size}\n'
        if end_s < DURATION_S:
            text += f"duration_s = {end_s - onset_s}\n"
    return text


def is_listed(kind, joint, span, faults):
    onset_s, end_s = span
    return any(f["kind"] == kind and f["joint"] == joint and abs(f["onset_s"] - onset_s) < NEAR_S and
               abs(f["end_s"] - end_s) < NEAR_S for f in faults)


def judge(cell, seed):
    """By pattern: logs in which all spans are listed, logs, findings more than those."""
    robot, folder = own_cells.Robot(random.Random(f"{cell} {own_cells.SEED}")), os.path.join(OUT, f"{cell}_{own_cells.SEED}")
    model, _ = own_cells.learn(folder, robot, own_cells.CELLS[cell], seed)
    runs = [((number, kind, joint), faults_text(robot, kind, joint, spans))
            for number, spans in enumerate(PATTERNS.values()) for kind in KINDS for joint in (1, 2, 3)]
    paths = own_cells.simulate(os.path.join(folder, "test"), robot, own_cells.CELLS[cell], seed + 1,
                               [("_".join(map(str, run)), text) for run, text in runs])
    tally = [[0, 0, 0] for _ in PATTERNS]
    for ((number, kind, joint), _), report in zip(runs, simulated.diagnose_all(paths, model)):
        spans, faults = list(PATTERNS.values())[number], report["faults"]
        tally[number][0] += all(is_listed(kind, joint, span, faults) for span in spans)
        tally[number][1] += 1
        tally[number][2] += max(0, len(faults) - len(spans))
    return tally


def main():
    totals = [[0, 0, 0] for _ in PATTERNS]
    for k, cell in enumerate(own_cells.CELLS):
        for total, own in zip(totals, judge(cell, 100 * own_cells.SEED + 10 * k)):
            total[:] = [a + b for a, b in zip(total, own)]
    print("| the fault | all its spans listed | findings more |\n|---|---|---|")
    for pattern, (listed, logs, more) in zip(PATTERNS, totals):
        print(f"| {pattern} | {listed} of {logs} | {more} |")


if __name__ == "__main__":
    main()
