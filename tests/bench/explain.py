#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scores one group of exact robots: found, right, named, and the error of the onset.

Usage: explain.py LABELS.csv GROUP_DIR    with GROUP_DIR/reports/FILE.json, as faultline_explain_logs leaves them
"""
import csv
import json
import os
import statistics
import sys


def main(labels_path, group):
    with open(labels_path, newline="") as file:
        rows = {row["file"]: row for row in csv.DictReader(file)}
    runs = found = right = named = 0
    errors, notes = [], []
    for name in sorted(os.listdir(os.path.join(group, "reports"))):
        row = rows[name.removesuffix(".json")]
        with open(os.path.join(group, "reports", name)) as file:
            faults = json.load(file)["faults"]
        want, onset = (row["fault"], int(row["joint"])), float(row["onset_s"])
        runs += 1
        after = [fault for fault in faults if fault["alarm_s"] >= onset - 1e-9]
        if not after:
            notes.append(f"{row['file']}: {want[0]} {want[1]} size {row['magnitude']} not found")
            continue
        said = (after[0]["kind"], after[0]["joint"])
        others = [(other["kind"], other["joint"]) for other in after[0]["could_also_be"]]
        found += 1
        right += said == want
        named += said == want or want in others
        errors.append(abs(after[0]["onset_s"] - onset))
        if said != want:
            notes.append(f"{row['file']}: {want[0]} {want[1]} reported {said[0]} {said[1]}")
    middle = f"{1e3 * statistics.median(errors):.1f} ms" if errors else "-"
    with open(os.path.join(group, "learn_s")) as file:
        learn_s = float(file.read())
    print(f"{os.path.basename(group)}: found {found} of {runs}, right {right}, named {named}; "
          f"median error of the onset {middle}; learned in {learn_s:.1f} s")
    print("\n".join(notes))


if __name__ == "__main__":
    main(*sys.argv[1:])
