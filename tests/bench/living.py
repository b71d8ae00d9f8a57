#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scores the diagnoses of living robots against their truth.

Usage: living.py LABELS.csv CELL_DIR...

A cell is a folder with learn_s (seconds that learning took) and reports/FILE.json for each test log of the
cell in the labels (file, fault, joint, onset_s, cell, use).
"""
import csv
import json
import os
import statistics
import sys

HEAD = ("cell", "healthy with alarm", "inconclusive", "found", "right", "or named", "early", "median/s",
        "unknown found", "called unknown", "calibration", "learn/s")
TIP = 3  # joint of the link that carries the payload, whatever joint a log is labelled with
BINS = 10


def read_json(path):
    with open(path) as file:
        return json.load(file)


def same(want, kind, joint):
    return kind == want[0] and joint == (TIP if kind == "payload_change" else want[1])


def calibration_error(judged):
    """Mean distance between the confidence that was said and how often it was right, over bins."""
    too_much = [0.0] * BINS
    for said, right in judged:
        too_much[min(int(said * BINS), BINS - 1)] += said - right
    return sum(map(abs, too_much)) / len(judged) if judged else float("nan")


class Score:
    def __init__(self):
        self.healthy = self.alarms = self.inconclusive = self.runs = self.found = self.right = self.named = 0
        self.early = self.unknown = self.unknown_found = self.called_unknown = 0
        self.delays, self.notes, self.judged, self.learn_s = [], [], [], 0.0

    def take_healthy(self, row, report):
        self.healthy += 1
        self.inconclusive += report["verdict"] == "inconclusive"
        if report["faults"]:
            self.alarms += 1
            said = ", ".join(f"{f['kind']} {f['joint']} at {f['alarm_s']:.2f}" for f in report["faults"])
            self.notes.append(f"{row['file']}: healthy, reported {said}")

    def take_unknown(self, row, after):
        self.unknown += 1
        self.unknown_found += bool(after)
        self.called_unknown += bool(after) and after[0]["kind"] == "unknown"
        self.judged += [(f["confidence"], f["kind"] == "unknown") for f in after[:1]]
        if not after or after[0]["kind"] != "unknown":
            said = f"{after[0]['kind']} {after[0]['joint']}" if after else "nothing"
            self.notes.append(f"{row['file']}: unknown {row['joint']} {row['what']}, reported {said}")

    def take_faulty(self, row, report):
        want, onset = (row["fault"], int(row["joint"])), float(row["onset_s"])
        early = [f for f in report["faults"] if f["alarm_s"] < onset - 1e-9]
        after = [f for f in report["faults"] if f["alarm_s"] >= onset - 1e-9]
        self.early += len(early)
        if early:
            self.notes.append(f"{row['file']}: early {early[0]['kind']} {early[0]['joint']} at "
                              f"{early[0]['alarm_s']:.2f}, onset {onset:.2f}")
        if want[0] == "unknown":
            return self.take_unknown(row, after)
        self.runs += 1
        if not after:
            self.notes.append(f"{row['file']}: {want[0]} {want[1]} size {row['magnitude']} not found")
            return None
        first = after[0]
        exact = same(want, first["kind"], first["joint"])
        others = any(same(want, other["kind"], other["joint"]) for other in first["could_also_be"])
        self.found += 1
        self.right += exact
        self.judged.append((first["confidence"], exact))
        self.named += exact or others
        self.delays.append(first["alarm_s"] - onset)
        if not exact:
            self.notes.append(f"{row['file']}: {want[0]} {want[1]} size {row['magnitude']}, reported "
                              f"{first['kind']} {first['joint']} after {first['alarm_s'] - onset:.3f} s"
                              f"{', named' if others else ''}")
        return None

    def line(self, name):
        delay = f"{statistics.median(self.delays):.4f}" if self.delays else "-"
        return (name, f"{self.alarms} of {self.healthy}", self.inconclusive, f"{self.found} of {self.runs}",
                self.right, self.named, self.early, delay, f"{self.unknown_found} of {self.unknown}",
                self.called_unknown, f"{calibration_error(self.judged):.3f}", f"{self.learn_s:.0f}")


def score_cell(labels, cell_dir):
    cell, score = os.path.basename(os.path.normpath(cell_dir)), Score()
    for row in labels:
        if row["cell"] != cell or row["use"] != "test":
            continue
        report = read_json(os.path.join(cell_dir, "reports", row["file"] + ".json"))
        (score.take_healthy if row["fault"] == "none" else score.take_faulty)(row, report)
    with open(os.path.join(cell_dir, "learn_s")) as file:
        score.learn_s = float(file.read())
    return cell, score


def total(scores):
    out = Score()
    for score in scores:
        for key, value in vars(score).items():
            setattr(out, key, getattr(out, key) + value)
    return out


def main(labels_path, cell_dirs):
    with open(labels_path, newline="") as file:
        labels = list(csv.DictReader(file))
    scores = [score_cell(labels, cell_dir) for cell_dir in cell_dirs]
    lines = [HEAD] + [score.line(cell) for cell, score in scores]
    lines.append(total(score for _, score in scores).line("all"))
    widths = [max(len(str(line[c])) for line in lines) for c in range(len(HEAD))]
    for line in lines:
        print("  ".join(str(value).rjust(width) for value, width in zip(line, widths)))
    print()
    for _, score in scores:
        print("\n".join(score.notes))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
