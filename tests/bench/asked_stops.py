#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Asks diagnose --at for the first sign before a stop, on faulty and on healthy logs of the sample robots.

Usage: asked_stops.py     called by asked_stops.sh
"""
import csv
import json
import os
import pathlib
import subprocess

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "asked-stops"
AFTER_S = {"industrial": 0.8, "bench": 1.5}  # from the onset to the stop
BEFORE_S, HELD_S = 5.0, 1.0
HEALTHY_LOGS, STOPS_A_LOG = 11, 2  # of each robot
NEAR_S = 0.075


def run(*command):
    return subprocess.run([FAULTLINE, *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          check=False).returncode


def table(log):
    """Returns names and rows of a log as numbers."""
    path = OUT / (log.stem + ".csv")
    run("convert", log, path)
    with open(path if path.exists() else log, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(v) for v in row] for row in rows[1:] if all(row)]


def snippet(log, stop_s):
    """Writes the rows up to the stop, and the robot that then stands; returns the path."""
    names, rows = table(log)
    time = names.index("t")
    kept = [row for row in rows if stop_s - BEFORE_S <= row[time] <= stop_s]
    step, held = rows[1][time] - rows[0][time], list(kept[-1])
    for k, name in enumerate(names):
        if name.startswith("dq"):
            held[k] = 0.0
    for i in range(1, round(HELD_S / step) + 1):
        held[time] = kept[-1][time] + step
        kept.append(list(held))
    path = OUT / ("cut_" + log.stem + ".csv")
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([names, *kept])
    return path


def sign_before(log, model, stop_s):
    """Returns the time of the first sign, None without one; 'none' where the program does not answer."""
    answer = OUT / "answer.json"
    answer.unlink(missing_ok=True)
    run("diagnose", log, "--model", model, "--at", stop_s, "--json", answer)
    if not answer.exists():
        return "none"
    sign = json.loads(answer.read_text())["stop"]["first_sign"]
    return sign and sign["time_s"]


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    near = faulty = asked = false = 0
    for robot in ("industrial", "bench"):
        samples = pathlib.Path("sample_logs") / robot
        model = OUT / robot
        if not model.exists():
            run("learn", *sorted(samples.glob("healthy_*")), "--robot", samples / "robot.toml", "-o", model)
        with open(samples / "labels.csv", encoding="utf-8") as file:
            labels = [row for row in csv.DictReader(file) if row["fault"] != "none"]
        for label in labels:
            onset, log = float(label["onset_s"]), samples / label["file"]
            stop = onset + AFTER_S[robot]
            stop = min(stop, float(label["duration_s"]) - 0.01)
            cut = snippet(log, stop)
            sign = sign_before(cut, model, max(float(r) for r in [table(cut)[1][-1][0]]) - HELD_S)
            faulty += 1
            near += isinstance(sign, float) and abs(sign - onset) <= NEAR_S
            text = f"first sign {sign - onset:+.3f} s from the onset" if isinstance(sign, float) else f"sign: {sign}"
            print(f"{robot:10} {label['file']:28} {text}")
        head = (samples / "spec.toml").read_text().split("[[run]]")[0]
        length = 8.0 if robot == "industrial" else 30.0
        runs = "".join(f'[[run]]\nname = "calm_{k}"\nduration_s = {length}\n\n' for k in range(HEALTHY_LOGS))
        spec = OUT / f"{robot}.toml"
        spec.write_text(head.replace("seed = ", "seed = 90") + runs)
        folder = OUT / f"calm_{robot}"
        run("simulate", spec, "-o", folder)
        for log in sorted(folder.glob("calm_*")):
            for part in range(STOPS_A_LOG):
                sign = sign_before(log, model, length * (0.45 + 0.4 * part))
                asked += 1
                false += sign is not None
    print(f"first sign within {1e3 * NEAR_S:.0f} ms of the onset: {near} of {faulty}; "
          f"signs before {asked} stops of healthy logs: {false}")


if __name__ == "__main__":
    main()
