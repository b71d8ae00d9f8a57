#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Learns real arms from undisturbed runs, diagnoses disturbed ones, and prints what was found of their pulses.

Usage: real_pulses.py DATA [ROBOT...]     called by real_pulses.sh
"""
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "real-pulses"
EARLY_S, LATE_S = 0.05, 0.5  # an alarm so long before or after a pulse is its own


def learn(robot, logs, model):
    """Whether a model was learned: logs that determine none are refused with exit status 3."""
    done = subprocess.run([FAULTLINE, "learn", *map(str, logs), "--robot", f"tests/bench/robots/{robot}.toml", "-o",
                           str(model)], stdout=subprocess.DEVNULL, check=False)
    if done.returncode not in (0, 3):
        done.check_returncode()
    return done.returncode == 0


def diagnose(log, model, report):
    subprocess.run([FAULTLINE, "diagnose", str(log), "--model", str(model), "--json", str(report)],
                   stdout=subprocess.DEVNULL, check=False)
    return json.loads(report.read_text())


def score(robot, data, pulses):
    folder = OUT / robot
    folder.mkdir(parents=True, exist_ok=True)
    healthy = sorted(data.glob(f"{robot}_undisturbed_*.csv"))
    if not learn(robot, healthy, folder / "model.json"):
        sys.exit(f"no model of {robot} was learned")
    found = right = false = 0
    delays = []
    mine = [p for p in pulses if p["file"].startswith(robot)]
    for log in sorted(data.glob(f"{robot}_perturbed_*.csv")):
        report = diagnose(log, folder / "model.json", folder / f"{log.stem}.json")
        left = list(report["faults"])
        for pulse in [p for p in mine if p["file"] == log.name]:
            begin, end = float(pulse["t_start_s"]), float(pulse["t_end_s"])
            hits = [f for f in left if begin - EARLY_S <= f["alarm_s"] <= end + LATE_S]
            if not hits:
                continue
            found += 1
            right += hits[0]["joint"] == int(pulse["joint"])
            delays.append(hits[0]["alarm_s"] - begin)
            left.remove(hits[0])
        false += len(left)
    alarms = inconclusive = refused = 0
    for log in healthy:
        model = folder / f"without_{log.stem}.json"
        if not learn(robot, [other for other in healthy if other != log], model):
            refused += 1
            continue
        report = diagnose(log, model, folder / f"{log.stem}.json")
        alarms += bool(report["faults"])
        inconclusive += report["verdict"] == "inconclusive"
    delay = f"{statistics.median(delays):.2f}" if delays else "-"
    print(f"| {robot} | {len(mine)} | {found} | {right} | {false} | {delay} | {alarms} of {len(healthy)} | "
          f"{inconclusive} | {refused} |", flush=True)


def main(data, robots):
    with open(data / "perturbation_labels.csv", newline="", encoding="utf-8") as file:
        pulses = list(csv.DictReader(file))
    print("| arm | pulses | found | joint | other findings | median delay/s | undisturbed, left out: with alarm | "
          "inconclusive | others refused |\n|---|---|---|---|---|---|---|---|---|")
    for robot in robots or ("acrobot", "pendubot"):
        score(robot, data, pulses)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2:])
