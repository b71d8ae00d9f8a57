#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Alters the sample logs as recorders do that fail, and counts what the program says of them.

Usage: missing_and_restarting.py FAULTLINE OUT [SEED]
OUT holds a model of each sample robot. The alterations, at random places:
  restart  the clock counts from 0 again before the fault begins
  ends     from the onset on, values are missing: of the whole log, of the faulty joint's position, or of all torque
  lost     3 % of the rows are not in the file
"""
import collections
import csv
import json
import pathlib
import random
import subprocess
import sys

ROBOTS = ["bench", "industrial", "rrpr"]
WAYS = ["restart", "ends", "lost"]
LOST_SHARE = 0.03


def read_log(faultline, path, folder):
    """Header and rows of a log as text."""
    table = folder / (path.stem + ".csv")
    if path.suffix != ".csv":
        subprocess.run([faultline, "convert", path, table], check=True, stdout=subprocess.DEVNULL)
        path = table
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], rows[1:]


def restart(header, rows, onset, joint, dice):
    """Between a fifth of the log and the onset, or four fifths of a healthy log, the clock is at 0 again."""
    times = [float(row[0]) for row in rows]
    before = max(k for k, t in enumerate(times) if t < onset)
    place = dice.randint(min(len(rows) // 5, before), before)
    zero = times[place]
    return [row if k < place else [repr(round(times[k] - zero, 9))] + row[1:] for k, row in enumerate(rows)]


def ends(header, rows, onset, joint, dice):
    what = dice.choice(["all", "joint", "torque"])
    lost = [k for k, name in enumerate(header)
            if k > 0 and (what == "all" or what == "torque" and name.startswith("tau")
                          or what == "joint" and name in (f"q{joint}", f"dq{joint}"))]
    return [[("" if k in lost else cell) for k, cell in enumerate(row)] if float(row[0]) >= onset else row
            for row in rows]


def lost(header, rows, onset, joint, dice):
    return [row for row in rows if dice.random() >= LOST_SHARE]


def verdict_of(faultline, log, model):
    report = subprocess.run([faultline, "diagnose", log, "--model", model, "--json", "-"], capture_output=True, text=True)
    if report.returncode not in (0, 1):
        return "refused", []
    diagnosis = json.loads(report.stdout)
    return diagnosis["verdict"], [f'{f["kind"]} {f["joint"]}' for f in diagnosis["faults"]]


def main():
    faultline, out = sys.argv[1], pathlib.Path(sys.argv[2])
    dice = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 35)
    counts = collections.Counter()
    for robot in ROBOTS:
        folder = out / robot
        folder.mkdir(exist_ok=True)
        samples = pathlib.Path("sample_logs") / robot
        with open(samples / "labels.csv", newline="") as file:
            labels = list(csv.DictReader(file))
        for label in labels:
            header, rows = read_log(faultline, samples / label["file"], folder)
            end = float(rows[-1][0])
            is_faulty = label["fault"] != "none"
            truth = "faulty" if is_faulty else "healthy"
            for way in WAYS:
                onset = float(label["onset_s"]) if is_faulty else dice.uniform(0.3, 0.8) * end
                joint = int(label["joint"]) if is_faulty else dice.randint(1, sum(n.startswith("q") for n in header))
                altered = folder / f'{pathlib.Path(label["file"]).stem}_{way}.csv'
                with open(altered, "w", newline="") as file:
                    csv.writer(file).writerows([header] + globals()[way](header, rows, onset, joint, dice))
                verdict, faults = verdict_of(faultline, altered, out / f"{robot}.json")
                counts[way, truth, verdict] += 1
                wrong = verdict == "healthy" if is_faulty else bool(faults)
                if wrong:
                    print(f'{robot} {altered.name}: {verdict} {", ".join(faults)}')
    print(f'{"":10}{"with a fault behind":>44}{"healthy":>44}')
    verdicts = ["healthy", "inconclusive", "faulty", "refused"]
    print(f'{"":10}' + 2 * "".join(f"{v:>14}" for v in verdicts))
    for way in WAYS:
        print(f"{way:10}" + "".join(f"{counts[way, t, v]:14}" for t in ("faulty", "healthy") for v in verdicts))
    calm = sum(counts[way, "faulty", "healthy"] for way in WAYS)
    named = sum(counts[way, "healthy", "faulty"] for way in WAYS)
    total = {t: sum(n for key, n in counts.items() if key[1] == t) for t in ("faulty", "healthy")}
    print(f'"healthy" with a fault behind: {calm} of {total["faulty"]}; a fault named in a healthy log: '
          f'{named} of {total["healthy"]}')
    sys.exit(calm > 0)


if __name__ == "__main__":
    main()
