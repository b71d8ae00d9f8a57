#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes faults into the recording of a real arm with six axes and prints which of them are found.

Usage: tx40_faults.py DATA     called by tx40_faults.sh
"""
import json
import os
import pathlib
import resource
import subprocess
import sys

import numpy as np
from scipy.signal import decimate

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "tx40-faults"
ROBOT = "tests/bench/robots/staubli_tx40.toml"
JOINTS, PIECES, BEGIN_S, END_S = 6, 4, 0.1, 7.5
# Motors to joints; motor 6 turns with axes 5 and 6. Currents count as torque before the gears.
GEARS = np.diag([32.0, 32.0, 45.0, -48.0, 45.0, 32.0])
GEARS[5, 4] = 32.0


def loss(table, joint, late):
    """The drive gives 60 % of the torque that the log states."""
    table[late, JOINTS + joint] /= 0.6


def offset(table, joint, late):
    """The logged torque is 60 % of its usual size too large."""
    table[late, JOINTS + joint] += 0.6 * np.sqrt(np.mean(table[:, JOINTS + joint] ** 2))


def bias(table, joint, late):
    """The position is a fiftieth of its range too large."""
    table[late, joint] += 0.02 * np.ptp(table[:, joint])


FAULTS = {"torque_loss": loss, "torque_sensor_error": offset, "sensor_bias": bias}


def recording(data):
    """Time, positions and torques of the joints, at 1 kHz."""
    load = lambda file: np.loadtxt(data / file, delimiter=",", skiprows=1)
    q = np.linalg.solve(GEARS, load("pos_read_data.csv").T).T
    tau = load("curr_data.csv") @ GEARS
    table = np.column_stack([decimate(x, 5, ftype="fir", axis=0, zero_phase=True) for x in (q, tau)])
    return np.arange(len(table)) / 1000.0, table


def write(path, time, table):
    names = ["t"] + [f"{kind}{j + 1}" for kind in ("q", "tau") for j in range(JOINTS)]
    np.savetxt(path, np.column_stack([time, table]), delimiter=",", header=",".join(names), comments="", fmt="%.10g")
    return path


def processor_s():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def faults_of(log, model):
    report = log.with_suffix(".json")
    subprocess.run([FAULTLINE, "diagnose", str(log), "--model", str(model), "--json", str(report)],
                   stdout=subprocess.DEVNULL, check=False)
    return json.loads(report.read_text())["faults"]


def main(data):
    OUT.mkdir(parents=True, exist_ok=True)
    time, table = recording(data)
    edges = np.linspace(BEGIN_S, END_S, PIECES + 1)
    pieces = [(time >= a) & (time < b) for a, b in zip(edges, edges[1:])]
    healthy = [write(OUT / f"piece_{i + 1}.csv", time[at], table[at]) for i, at in enumerate(pieces)]
    model = OUT / "model.json"
    subprocess.run([FAULTLINE, "learn", *map(str, healthy), "--robot", ROBOT, "-o", str(model)],
                   stdout=subprocess.DEVNULL, check=True)
    learning_s = processor_s()
    alarms, score = 0, {kind: [[0, 0] for _ in range(JOINTS)] for kind in FAULTS}
    for piece, at in enumerate(pieces):
        alarms += bool(faults_of(healthy[piece], model))
        late = time[at] > 0.5 * (edges[piece] + edges[piece + 1])
        for kind, spoil in FAULTS.items():
            for joint in range(JOINTS):
                changed = table[at].copy()
                spoil(changed, joint, late)
                found = faults_of(write(OUT / f"{kind}_{joint + 1}_{piece + 1}.csv", time[at], changed), model)
                score[kind][joint][0] += bool(found)
                score[kind][joint][1] += any((f["kind"], f["joint"]) == (kind, joint + 1) for f in found)
    print(f"| fault, found and right of {PIECES} | " + " | ".join(f"joint {j + 1}" for j in range(JOINTS)) + " |")
    print("|---" * (JOINTS + 1) + "|")
    for kind, joints in score.items():
        print(f"| {kind} | " + " | ".join(f"{found}, {right}" for found, right in joints) + " |")
    print(f"\nHealthy pieces with an alarm: {alarms} of {PIECES}.")
    print(f"Processor time: {learning_s:.0f} s to learn, {processor_s() - learning_s:.0f} s for "
          f"{PIECES * (1 + len(FAULTS) * JOINTS)} diagnoses.")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
