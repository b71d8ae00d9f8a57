#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What became of the sample robots' logs, and what learning said of itself.

Usage: sample_robots.py GROUP_DIR...    folders as study.sh leaves them
"""
import csv
import json
import os
import sys


def read_json(path):
    with open(path) as file:
        return json.load(file)


def judge(row, faults):
    """Whether the first finding at or after the onset is exactly right; findings before it; findings too many."""
    onset = float(row["onset_s"])
    early = sum(fault["alarm_s"] < onset - 1e-9 for fault in faults)
    after = [fault for fault in faults if fault["alarm_s"] >= onset - 1e-9]
    right = bool(after) and (after[0]["kind"], after[0]["joint"]) == (row["fault"], int(row["joint"]))
    return right, early, max(len(after) - 1, 0)


def score(group):
    with open(os.path.join(group, "labels.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    total = {"bad": 0, "right": 0, "early": 0, "more": 0, "healthy": 0, "alarms": 0}
    notes = []
    for row in rows:
        faults = read_json(os.path.join(group, "reports", row["file"] + ".json"))["faults"]
        if row["fault"] == "none":
            total["healthy"] += 1
            total["alarms"] += bool(faults)
            continue
        right, early, more = judge(row, faults)
        total["bad"] += 1
        total["right"] += right
        total["early"] += early
        total["more"] += more
        if not right or early or more:
            said = ", ".join(f"{f['kind']} {f['joint'] or '-'} at {f['onset_s']:.2f}" for f in faults) or "nothing"
            notes.append(f"{os.path.basename(group)}/{row['file']}: {row['fault']} {row['joint']}, reported {said}")
    return total, notes


def main(groups):
    print("| robot | bad runs named right | early | findings too many | healthy with alarm | simulated: right of found, "
          "of runs | false alarms | early | calibration error, before | threshold | learn/s |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    every = []
    for group in groups:
        total, notes = score(group)
        every += notes
        learned = read_json(os.path.join(group, "learn.json"))
        validation = learned["validation"]
        runs, found, right = (sum(r[k] for r in validation["rows"])
                              for k in ("runs", "detected", "right_kind_and_joint"))
        model = read_json(os.path.join(group, "model.json"))
        with open(os.path.join(group, "learn_s")) as file:
            learn_s = float(file.read())
        print(f"| {os.path.basename(group)} | {total['right']} of {total['bad']} | {total['early']} | {total['more']} "
              f"| {total['alarms']} of {total['healthy']} | {right} of {found} of {runs} "
              f"| {validation['false_alarms']} in {validation['healthy_hours']:.2f} h | {validation['early_alarms']} "
              f"| {validation['confidence_error']:.2f}, {validation['raw_confidence_error']:.2f} "
              f"| {model['evidence']['threshold']:.0f} | {learn_s:.0f} |")
    print("\n" + "\n".join(every or ["every sample log is exactly right"]))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
