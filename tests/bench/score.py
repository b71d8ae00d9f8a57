#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scores diagnoses against their truth.

Usage: score.py GROUP_DIR...

A group is a folder with labels.csv (file, fault, joint, onset_s), learn.json (faultline learn --json),
learn_s (seconds that learning took) and reports/FILE.json for each file of the labels. A column m1, l1 ... of
the labels is the true value of that parameter.
"""
import csv
import json
import os
import statistics
import sys

STOPPED = ("free_swinging", "locked")
# A vertical joint that is locked and one whose encoder repeats can look alike.
ALIKE = {("locked", 3): ("stuck_encoder", 3), ("stuck_encoder", 3): ("locked", 3)}


def read_json(path):
    with open(path) as file:
        return json.load(file)


def label_of(entry):
    return entry["kind"], entry["joint"]


class Tally:
    def __init__(self):
        self.runs = self.found = self.exact = self.named = self.stopped_right = 0
        self.delays, self.onset_errors = [], []


def score_run(row, report, tally):
    """Counts one faulty run; returns (alarms before the onset, a line on what was not exact or None)."""
    want, onset = (row["fault"], int(row["joint"])), float(row["onset_s"])
    faults = report["faults"]
    early = sum(fault["alarm_s"] < onset - 1e-9 for fault in faults)
    after = [fault for fault in faults if fault["alarm_s"] >= onset - 1e-9]
    tally.runs += 1
    if not after:
        return early, f"{row['file']}: {want[0]} {want[1]} size {size_of(row)} not found"
    first = after[0]
    others = [label_of(other) for other in first["could_also_be"]]
    exact = label_of(first) == want
    named = exact or want in others
    tally.found += 1
    tally.exact += exact
    tally.named += named
    tally.stopped_right += exact or (named and label_of(first) == ALIKE.get(want))
    tally.delays.append(first["alarm_s"] - onset)
    tally.onset_errors.append(abs(first["onset_s"] - onset))
    if exact:
        return early, None
    said = f"{first['kind']} {first['joint'] or '-'}"
    return early, (f"{row['file']}: {want[0]} {want[1]} size {size_of(row)} reported as {said}, "
                   f"{'right one named as alternative' if named else 'right one not named'}, "
                   f"alarm after {first['alarm_s'] - onset:.3f} s")


def size_of(row):
    return row.get("size") or row.get("magnitude") or "-"


def truth_of(row):
    """True a, b, c, m3 of two rods and a point at the tip, when the labels hold the masses."""
    if not row.get("m1"):
        return {}
    m1, m2, m3, l1, l2 = (float(row[key]) for key in ("m1", "m2", "m3", "l1", "l2"))
    return {"a": (m1 / 3 + m2 + m3) * l1 ** 2, "b": (m2 / 3 + m3) * l2 ** 2,
            "c": (m2 / 2 + m3) * l1 * l2, "m3": m3}


def parameter_errors(group, row):
    truth = truth_of(row)
    if not truth:
        return ""
    identification = read_json(os.path.join(group, "learn.json"))["identification"]
    values = {p["name"]: p["value"] for p in identification.get("base_parameters", [])}
    if not truth.keys() <= values.keys():
        return "no identified parameters in learn.json"
    return "  ".join(f"{name} {100 * (values[name] / true - 1):+.4f} %" for name, true in truth.items())


def score_group(group):
    with open(os.path.join(group, "labels.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    result = {"healthy": 0, "alarms": 0, "early": 0, "stopped": Tally(), "other": Tally(), "notes": []}
    for row in rows:
        report = read_json(os.path.join(group, "reports", row["file"] + ".json"))
        if row["fault"] == "none":
            result["healthy"] += 1
            result["alarms"] += len(report["faults"])
            continue
        tally = result["stopped" if row["fault"] in STOPPED else "other"]
        early, note = score_run(row, report, tally)
        result["early"] += early
        if note:
            result["notes"].append(note)
    with open(os.path.join(group, "learn_s")) as file:
        result["learn_s"] = float(file.read())
    result["parameters"] = parameter_errors(group, rows[0])
    return result


def median(delays):
    return f"{statistics.median(delays):.4f}" if delays else "-"


def table_line(name, healthy, alarms, early, stopped, other):
    return (f"{name:<14}{f'{alarms} in {healthy}':>12}{early:>7}"
            f"{f'{stopped.stopped_right} of {stopped.runs}':>12}{median(stopped.delays):>10}"
            f"{f'{other.found} of {other.runs}':>11}{f'{other.named} of {other.runs}':>11}{other.exact:>7}"
            f"{median(other.delays):>10}{median(stopped.onset_errors + other.onset_errors):>10}")


def added(tallies):
    total = Tally()
    for tally in tallies:
        for key, value in vars(tally).items():
            setattr(total, key, getattr(total, key) + value)
    return total


def main(groups):
    results = {os.path.basename(os.path.normpath(group)): score_group(group) for group in groups}
    print(f"{'':<14}{'false':>12}{'early':>7}{'free/locked':>12}{'median':>10}"
          f"{'others':>11}{'right or':>11}{'':>7}{'median':>10}{'onset':>10}")
    print(f"{'group':<14}{'alarms':>12}{'alarms':>7}{'right':>12}{'delay/s':>10}"
          f"{'found':>11}{'named':>11}{'right':>7}{'delay/s':>10}{'off by/s':>10}")
    keys = ("healthy", "alarms", "early", "stopped", "other")
    for name, result in results.items():
        print(table_line(name, *(result[key] for key in keys)))
    every = list(results.values())
    print(table_line("all", *(sum(r[key] for r in every) for key in keys[:3]),
                     *(added(r[key] for r in every) for key in keys[3:])))
    print("\nlearning, and errors of the identified parameters where the truth is known")
    for name, result in results.items():
        print(f"{name:<14}{result['learn_s']:>6.1f} s  {result['parameters']}")
    print("\nnot exactly right")
    for name, result in results.items():
        for note in result["notes"]:
            print(f"{name:<14}{note}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
