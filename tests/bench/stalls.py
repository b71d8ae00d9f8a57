#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Learns how joints without torque follow their references, and prints which of their faults are found.

Usage: stalls.py FOLDER     with the real logs; called by stalls.sh
"""
import csv
import json
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "stalls"
EARLY_S, LATE_S = 0.1, 1.0  # an alarm so long before or after a fault is its own
PERIOD_S = 0.01
JOINTS = 2
GAIN, ACCELERATION = 6.0, 12.0  # of the position loop, 1/s, and what the motors can, rad/s^2


def references(seed, t, pace):
    rng = random.Random(seed)
    out = []
    for _ in range(JOINTS):
        q = dq = 0.0
        for _ in range(3):
            size, w, phase = rng.uniform(0.2, 0.7), pace * rng.uniform(0.4, 2.2), rng.uniform(0, 6.28)
            q += size * math.sin(w * t + phase)
            dq += size * w * math.cos(w * t + phase)
        out.append((q, dq))
    return out


def simulated(path, seed, duration_s, fault=None, pace=1.0):
    """fault: (kind, joint, begin, end)."""
    rng = random.Random(1000 + seed)
    gain = GAIN * rng.uniform(0.95, 1.05)  # of that day
    q = [r[0] for r in references(seed, 0.0, pace)]
    dq = [0.0] * JOINTS
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(["t", *(f"{name}{j + 1}" for name in ("q", "dq", "q_ref", "dq_ref") for j in range(JOINTS))])
        for k in range(int(duration_s / PERIOD_S)):
            t = k * PERIOD_S
            wanted = references(seed, t, pace)
            moved = list(dq)
            for j in range(JOINTS):
                ask = wanted[j][1] + gain * (wanted[j][0] - q[j])
                dq[j] += max(-ACCELERATION * PERIOD_S, min(ACCELERATION * PERIOD_S, ask - dq[j]))
                moved[j] = dq[j]
                if fault and fault[1] == j and fault[2] <= t < fault[3]:
                    kind = fault[0]
                    moved[j] *= {"stall": 0.0, "drag": 0.7, "slip": 0.0 if k % 5 < 2 else 1.0}[kind]
                q[j] += PERIOD_S * moved[j]
            out.writerow([f"{t + rng.uniform(-0.001, 0.001):.5f}",
                          *(f"{round((x + rng.gauss(0, 2e-4)) / 1e-4) * 1e-4:.6f}" for x in q),
                          *(f"{x + rng.gauss(0, 0.01):.5f}" for x in moved),
                          *(f"{r[0]:.6f}" for r in wanted), *(f"{r[1]:.6f}" for r in wanted)])


def learn(logs, robot, model):
    subprocess.run([FAULTLINE, "learn", *map(str, logs), "--robot", str(robot), "-o", str(model)],
                   stdout=subprocess.DEVNULL, check=True)


def findings(log, model):
    report = log.with_suffix(".json")
    subprocess.run([FAULTLINE, "diagnose", str(log), "--model", str(model), "--json", str(report)],
                   stdout=subprocess.DEVNULL, check=False)
    return json.loads(report.read_text())


def row(name, faulty, healthy):
    """faulty: ((kind, joint, begin, end), diagnosis)."""
    found, joint, others, delays = 0, 0, 0, []
    for (_, at, begin, end), diagnosis in faulty:
        faults = diagnosis["faults"]
        hits = [f for f in faults if begin - EARLY_S <= f["alarm_s"] <= end + LATE_S]
        others += len(faults) - bool(hits)
        if hits:
            found += 1
            joint += hits[0]["joint"] == at + 1
            delays.append(hits[0]["alarm_s"] - begin)
    quiet = sum(d["verdict"] == "healthy" for d in healthy)
    alarms = sum(bool(d["faults"]) for d in healthy)
    delay = f"{statistics.median(delays):.2f}" if delays else "-"
    print(f"| {name} | {len(faulty)} | {found} | {joint} | {others} | {delay} | {alarms} of {len(healthy)} | {quiet} |",
          flush=True)


def simulated_rows():
    robot = OUT / "steppers.toml"
    robot.write_text('name = "steppers"\naxes = "RR"\n', encoding="utf-8")
    logs = [OUT / f"learn_{seed}.csv" for seed in range(1, 5)]
    for seed, log in enumerate(logs, 1):
        simulated(log, seed, 30.0)
    model = OUT / "steppers.model"
    learn(logs, robot, model)
    healthy = []
    for seed in range(40, 48):
        log = OUT / f"healthy_{seed}.csv"
        simulated(log, seed, 30.0, pace=1.0 if seed < 44 else 0.5)
        healthy.append(findings(log, model))
    for kind in ("stall", "drag", "slip"):
        faulty = []
        for i, length in enumerate((0.2, 0.3, 0.5, 0.5, 1.0, 1.0, 2.0, 2.0)):
            fault = (kind, i % JOINTS, 10.0, 10.0 + length)
            log = OUT / f"{kind}_{i}.csv"
            simulated(log, 60 + i, 20.0, fault)
            faulty.append((fault, findings(log, model)))
        row(f"simulated steppers: {kind}", faulty, healthy)


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    return header, rows


def write(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(header)
        out.writerows(rows)


def stalled(rows, t, q, dq, begin, end, catch_up=0.5):
    """The joint stands from begin to end and has caught up a while later."""
    out, frozen = [], None
    for cells in rows:
        cells = list(cells)
        now = float(cells[t])
        if begin <= now < end:
            frozen = cells[q] if frozen is None else frozen
            cells[q], cells[dq] = frozen, "0.0"
        elif frozen is not None and end <= now < end + catch_up:
            share = (now - end) / catch_up
            cells[q] = f"{float(frozen) + share * (float(cells[q]) - float(frozen)):.9f}"
        out.append(cells)
    return out


def real_row(name, path, columns, learned_share, lengths):
    header, rows = read(path)
    names = [cell.split(" [")[0] for cell in header]
    place = {key: names.index(value) for key, (value, _) in columns.items()}
    robot = OUT / f"{path.stem}.toml"
    robot.write_text('name = "stepper"\naxes = "R"\n[log.columns]\n' + "".join(
        f'{key} = {{name = "{value}", unit = "{unit}"}}\n' for key, (value, unit) in columns.items()),
        encoding="utf-8")
    cut = int(learned_share * len(rows))
    write(OUT / f"{path.stem}_learn.csv", header, rows[:cut])
    learn([OUT / f"{path.stem}_learn.csv"], robot, OUT / f"{path.stem}.model")
    rest = OUT / f"{path.stem}_healthy.csv"
    write(rest, header, rows[cut:])
    healthy = [findings(rest, OUT / f"{path.stem}.model")]
    start, stop = float(rows[cut][place["t"]]), float(rows[-1][place["t"]])
    faulty = []
    for i, length in enumerate(lengths):
        begin = start + 2.0 + (stop - start - 6.0) * (i + 0.5) / len(lengths)
        moving = abs(statistics.fmean(float(r[place["dq_ref1"]]) for r in rows
                                      if begin <= float(r[place["t"]]) < begin + length))
        largest = max(abs(float(r[place["dq_ref1"]])) for r in rows)
        if moving < 0.2 * largest:
            continue  # nothing to stall
        log = OUT / f"{path.stem}_{i}.csv"
        write(log, header, stalled(rows[cut:], place["t"], place["q1"], place["dq1"], begin, begin + length))
        faulty.append((("stall", 0, begin, begin + length), findings(log, OUT / f"{path.stem}.model")))
    row(name, faulty, healthy)


def real_rows(folder):
    lengths = (0.2, 0.3, 0.5, 0.5, 0.7, 1.0, 1.0, 1.5, 2.0, 0.4, 0.3, 0.2)
    top = "/velocity_joint_trajectory_controller/controller_state/"
    real_row("real SCARA, soft loop, 50 Hz", folder / "plotjuggler_export.csv",
             {"t": ("__time", "s"), "q1": (top + "feedback/positions[0]", "rad"),
              "dq1": (top + "feedback/velocities[0]", "rad/s"), "q_ref1": (top + "reference/positions[0]", "rad"),
              "dq_ref1": (top + "output/velocities[0]", "rad/s")}, 0.5, lengths)
    real_row("real SCARA, one stepper, 100 Hz", folder / "stall_100hz.csv",
             {"t": ("Program Time", "s"), "q1": ("q", "deg"), "dq1": ("qd", "deg/s"),
              "q_ref1": ("q_set", "deg"), "dq_ref1": ("qd_set", "deg/s")}, 0.75, lengths)


def main(folder):
    OUT.mkdir(parents=True, exist_ok=True)
    print("| robot: fault | logs | found | joint | other findings | median delay, s | healthy: with alarm | "
          "called healthy |\n|---|---|---|---|---|---|---|---|")
    simulated_rows()
    if folder.exists():
        real_rows(folder)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
