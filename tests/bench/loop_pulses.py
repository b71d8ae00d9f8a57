#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Learns a linear axis in its position loop, diagnoses logs with pulses in the command, and prints what was found.

Usage: loop_pulses.py DATA_EMPS.csv     called by loop_pulses.sh
"""
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "loop-pulses"
ROBOT = "tests/bench/robots/emps.toml"
EARLY_S, LATE_S = 0.05, 0.5  # an alarm so long before or after a pulse is its own
PERIOD_S = 0.001
VOLTS = 35.15065  # N a volt
MASS, VISCOUS, COULOMB, OFFSET = 95.1, 203.5, 20.4, -3.2  # as published for the real axis
KP, KV = 160.0, 243.0 / VOLTS  # of the simulated loop


def reference(t, seed):
    rng = random.Random(seed)
    position = 0.0
    for _ in range(3):
        amplitude, frequency, phase = rng.uniform(0.02, 0.06), rng.uniform(0.15, 0.8), rng.uniform(0, 6.28)
        position += amplitude * (math.sin(2 * math.pi * frequency * t + phase) - math.sin(phase))
    return position


def simulated(path, seed, duration_s, pulses=(), friction=1.0):
    """A cascade of position and speed loop; pulses (begin, end, V) are added to what it commands."""
    rng = random.Random(1000 + seed)
    q = dq = 0.0
    code = 1e-6
    last_read = 0.0
    speed = 0.0
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(["t", "qm", "qg", "vir"])
        for k in range(int(duration_s / PERIOD_S)):
            t = k * PERIOD_S
            read = code * round((q + rng.gauss(0.0, 0.3 * code)) / code)
            speed += 0.5 * ((read - last_read) / PERIOD_S - speed)
            last_read = read
            wanted = reference(t, seed)
            volts = KV * (KP / 10.0 * (wanted - read) - speed)
            volts += sum(size for begin, end, size in pulses if begin <= t < end)
            volts = max(-10.0, min(10.0, volts))
            out.writerow([f"{t:.6f}", f"{read:.7f}", f"{wanted:.9f}", f"{volts:.8f}"])
            for _ in range(4):
                force = VOLTS * volts - friction * (VISCOUS * dq + COULOMB * math.tanh(dq / 0.002)) - OFFSET
                dq += PERIOD_S / 4 * force / MASS
                q += PERIOD_S / 4 * dq


def pulses_of(seed, duration_s, smallest, largest, count):
    rng = random.Random(seed)
    pulses = []
    for i in range(count):
        begin = 2.0 + i * (duration_s - 3.0) / count + rng.uniform(0.0, 0.5)
        length = rng.choice([0.03, 0.1, 0.2, 0.5])
        size = math.exp(rng.uniform(math.log(smallest), math.log(largest))) * rng.choice([-1, 1])
        pulses.append((begin, begin + length, size))
    return pulses


def learn(logs, model):
    subprocess.run([FAULTLINE, "learn", *map(str, logs), "--robot", ROBOT, "-o", str(model)],
                   stdout=subprocess.DEVNULL, check=True)


def findings(log, model):
    report = log.with_suffix(".json")
    subprocess.run([FAULTLINE, "diagnose", str(log), "--model", str(model), "--json", str(report)],
                   stdout=subprocess.DEVNULL, check=False)
    return json.loads(report.read_text())["faults"]


def scored(runs):
    """runs: (pulses, findings) of each log."""
    count = found = others = 0
    for pulses, left in runs:
        left = list(left)
        for begin, end, _ in pulses:
            count += 1
            hits = [f for f in left if begin - EARLY_S <= f["alarm_s"] <= end + LATE_S]
            if hits:
                found += 1
                left.remove(hits[0])
        others += len(left)
    return count, found, others


def row(name, runs, healthy):
    count, found, others = scored(runs)
    alarms = sum(bool(f) for f in healthy)
    print(f"| {name} | {count} | {found} | {others} | {alarms} of {len(healthy)} |", flush=True)


def simulated_rows():
    for seed in (1, 2):
        simulated(OUT / f"learn_{seed}.csv", seed, 20.0)
    learn([OUT / "learn_1.csv", OUT / "learn_2.csv"], OUT / "simulated.json")
    runs, healthy = [], []
    for seed in range(11, 17):
        log, pulses = OUT / f"pulses_{seed}.csv", pulses_of(seed, 15.0, 0.1, 1.0, 5)
        simulated(log, seed, 15.0, pulses)
        runs.append((pulses, findings(log, OUT / "simulated.json")))
    for seed, friction in ((21, 1.0), (22, 0.8), (23, 1.2), (24, 1.2)):
        log = OUT / f"healthy_{seed}.csv"
        simulated(log, seed, 15.0, friction=friction)
        healthy.append(findings(log, OUT / "simulated.json"))
    row("simulated loop, .1 to 1 V", runs, healthy)


def write_rows(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(header)
        out.writerows(rows)


def real_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    half = len(rows) // 2
    write_rows(OUT / "real_learn.csv", header, rows[:half])
    learn([OUT / "real_learn.csv"], OUT / "real.json")
    write_rows(OUT / "real_healthy.csv", header, rows[half:])
    healthy = [findings(OUT / "real_healthy.csv", OUT / "real.json")]
    runs = []
    for seed in (31, 32, 33, 34):
        start = float(rows[half][0])
        pulses = [(start + b, start + e, size) for b, e, size in pulses_of(seed, 11.0, 0.1, 1.0, 4)]
        changed = []
        for t, q, wanted, volts in rows[half:]:
            more = sum(size for begin, end, size in pulses if begin <= float(t) < end)
            changed.append([t, q, wanted, f"{float(volts) + more:.8f}"])
        log = OUT / f"real_{seed}.csv"
        write_rows(log, header, changed)
        runs.append((pulses, findings(log, OUT / "real.json")))
    row("real axis, .1 to 1 V by hand", runs, healthy)


def main(data):
    OUT.mkdir(parents=True, exist_ok=True)
    print("| axis | pulses | found | other findings | without pulses: with alarm |\n|---|---|---|---|---|")
    simulated_rows()
    if data.exists():
        real_rows(data)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
