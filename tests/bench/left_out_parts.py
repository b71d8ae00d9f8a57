#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Diagnoses parts of healthy recordings with models learned from their other parts, and prints what was found.

Usage: left_out_parts.py DATA [ROBOT...]     called by left_out_parts.sh
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "left-out-parts"
ROBOTS = pathlib.Path("tests/bench/robots")
PARTS = 3


def run(*arguments):
    """The exit status of the program and what it wrote; inputs that it refuses (3) are a result."""
    done = subprocess.run([FAULTLINE, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 3):
        sys.exit(f"{' '.join(map(str, arguments))}: exit status {done.returncode}\n{done.stderr}")
    return done.returncode, done.stderr


def converted(log, robot, folder):
    run("convert", log, folder / "whole.csv", "--robot", robot)
    return (folder / "whole.csv").read_text().splitlines()


def text_of(log, _robot, _folder):
    return log.read_text().splitlines()


def joined_tx40(data, _robot, _folder):
    sys.path.insert(0, "tests/bench")
    import tx40_faults
    stamps, table = tx40_faults.recording(data)
    names = ["t"] + [f"{kind}{j}" for kind in ("q", "tau") for j in range(1, 7)]
    moving = (stamps >= tx40_faults.BEGIN_S) & (stamps <= tx40_faults.END_S)
    rows = np.column_stack([stamps, table])[moving]
    return [",".join(names)] + [",".join(f"{x:.10g}" for x in row) for row in rows]


# Robot file, recording below the data folder, and what makes lines of text of it.
RECORDINGS = {
    "ur3": ("ur3.toml", "ur3-rosbag1/id1.bag", converted),
    "ur10": ("ur10.toml", "ur10-panda-rosbag2/ur10_exciting_trajectory.db3", converted),
    "tx40": ("staubli_tx40.toml", "staubli-tx40", joined_tx40),
    "doosan": ("doosan_m0609.toml", "doosan/free.csv", text_of),
    "doosan_current": ("doosan_m0609_current.toml", "doosan/free.csv", text_of),
}


def cut(lines, folder):
    """Writes the parts of a recording; comments and the header stand before each."""
    head = next(k for k, line in enumerate(lines) if not line.startswith("#")) + 1
    rows = lines[head:]
    paths = []
    for k in range(PARTS):
        part = rows[k * len(rows) // PARTS:(k + 1) * len(rows) // PARTS]
        paths.append(folder / f"part_{k + 1}.csv")
        paths[-1].write_text("\n".join(lines[:head] + part) + "\n")
    return paths


def judged(name, robot, parts, folder):
    """Diagnoses each part with a model learned from the others, and prints a row."""
    alarms = inconclusive = refused = 0
    said, seconds = [], []
    for part in parts:
        model, report = folder / f"without_{part.stem}.json", folder / f"{part.stem}.json"
        begin = time.monotonic()
        status, why = run("learn", *[p for p in parts if p != part], "--robot", robot, "-o", model)
        if status == 3:
            refused += 1
            said.append(f"without {part.name}: {why.strip().splitlines()[-1]}")
            continue
        seconds.append(time.monotonic() - begin)
        run("diagnose", part, "--model", model, "--json", report)
        verdict = json.loads(report.read_text())
        alarms += bool(verdict["faults"])
        inconclusive += verdict["verdict"] == "inconclusive"
        said += [f"{part.name}: {f['kind']} at joint {f['joint']} from {f['onset_s']:.2f} s" for f in verdict["faults"]]
    learned = f"{statistics.median(seconds):.0f}" if seconds else "-"
    print(f"| {name} | {len(parts)} | {alarms} | {inconclusive} | {refused} | {learned} |", flush=True)
    for line in said:
        print(f"    {line}", file=sys.stderr, flush=True)


def main(data, names):
    print("| recording | parts | with alarm | inconclusive | refused | learn/s (median) |\n|---|---|---|---|---|---|")
    for name in names or RECORDINGS:
        folder = OUT / name
        folder.mkdir(parents=True, exist_ok=True)
        robot, log, lines_of = RECORDINGS[name]
        parts = cut(lines_of(data / log, ROBOTS / robot, folder), folder)
        judged(name, ROBOTS / robot, parts, folder)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), sys.argv[2:])
