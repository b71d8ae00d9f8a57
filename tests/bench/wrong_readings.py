#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sample logs of three robots, written as if their columns meant something else than the robot file says: what is
said of them.

Usage: wrong_readings.py FAULTLINE OUT ROBOT=MODEL...
Each model is that of sample_logs/ROBOT; OUT/ROBOT holds model and the logs it makes. Prints a table; every log that
is called healthy, or in which a fault is named, stands below it.
"""
import csv
import json
import math
import os
import subprocess
import sys

DEGREES = 180.0 / math.pi
LOGS = {  # a healthy one, and ones with faults that begin late, early and at the end
    "bench": ["healthy_2.csv", "torque_loss_1.csv", "collision_1.csv", "payload_change.csv"],
    "industrial": ["healthy_2.flog", "locked_2.flog", "sensor_bias_1.flog", "torque_loss_3.flog"],
    "rrpr": ["healthy_2.flog", "torque_loss_2.flog", "stuck_encoder_1.flog", "payload_change.flog"],
}
ORDER = {"bench": "RRP", "industrial": "RRP", "rrpr": "RRPR"}


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    names = rows[0]
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(names)}


def write(path, log):
    with open(path, "w", newline="") as file:
        file.write(",".join(log) + "\n")
        for row in zip(*log.values()):
            file.write(",".join(repr(v) for v in row) + "\n")


def scaled(*names_and_factor):
    *names, factor = names_and_factor

    def change(log):
        for name in names:
            log[name] = [v * factor for v in log[name]]
    return change


def swapped(pairs):
    def change(log):
        for a, b in pairs:
            log[a], log[b] = log[b], log[a]
    return change


def late_torque(seconds):
    def change(log):
        t = log["t"]
        period = (t[-1] - t[0]) / (len(t) - 1)
        rows = max(1, round(seconds / period))
        for name in log:
            if name.startswith("tau"):
                log[name] = [log[name][0]] * rows + log[name][:-rows]
    return change


def slower(factor):
    return scaled("t", factor)


def current(factors):
    def change(log):
        for j, factor in enumerate(factors, 1):
            scaled(f"tau{j}", factor)(log)
    return change


def readings(robot):
    """Name, words of which one must stand in the reason, and the change, for each wrong reading of a robot."""
    axes = ORDER[robot]
    turning = [j for j, kind in enumerate(axes, 1) if kind == "R"]
    sliding = [j for j, kind in enumerate(axes, 1) if kind == "P"]
    n = len(axes)
    yield "degrees", ["deg"], scaled(*[f"{c}{j}" for j in turning for c in ("q", "dq")], DEGREES)
    yield "one axis in degrees", ["deg"], scaled("q2", "dq2", DEGREES)
    yield "millimetres", ["mm"], scaled(*[f"{c}{j}" for j in sliding for c in ("q", "dq")], 1e3)
    yield "velocities in degrees", ["deg"], scaled(*[f"dq{j}" for j in turning], DEGREES)
    yield "torque in mN m", ["1000", "thousand", "another quantity"], scaled(*[f"tau{j}" for j in range(1, n + 1)], 1e3)
    yield "current in A", ["current"], current([0.37, 0.52, 0.081, 0.9][:n])
    yield "current in mA", ["current", "1000"], current([370.0, 520.0, 81.0, 900.0][:n])
    yield "time in ms", ["ms", "millisecond"], scaled("t", 1e3)
    yield "joints 1 and 2 swapped", ["swapped"], swapped([("q1", "q2"), ("dq1", "dq2"), ("tau1", "tau2")])
    yield "torques 1 and 2 swapped", ["swapped"], swapped([("tau1", "tau2")])
    yield "sign of tau2", ["sign"], scaled("tau2", -1.0)
    yield "sign of joint 1", ["sign"], scaled("q1", "dq1", -1.0)
    yield "torque .25 s late", ["late"], late_torque(0.25)
    yield "time 1.5 times", ["time", "period", "clock", "stamp"], slower(1.5)
    yield "torque of another gear: 60 %", ["another quantity"], scaled(*[f"tau{j}" for j in range(1, n + 1)], 0.6)


def diagnose(faultline, path, model):
    out = path + ".json"
    run = subprocess.run([faultline, "diagnose", path, "--model", model, "--json", out], capture_output=True, text=True)
    if run.returncode > 1:
        return {"verdict": "refused", "verdict_reason": run.stderr.strip(), "faults": []}
    with open(out) as file:
        return json.load(file)


def main(faultline, out, models):
    total = {"logs": 0, "healthy": 0, "named": 0, "cause": 0}
    notes = []
    print("| robot | wrong reading | logs | healthy | fault named | right cause |\n|---|---|---|---|---|---|")
    for robot, model in models:
        folder = os.path.join(out, robot)
        os.makedirs(folder, exist_ok=True)
        plain = {}
        for name in LOGS[robot]:
            path = os.path.join(folder, name.rsplit(".", 1)[0] + ".csv")
            subprocess.run([faultline, "convert", f"sample_logs/{robot}/{name}", path], check=True,
                           capture_output=True)
            plain[name] = read(path)
        for what, words, change in readings(robot):
            row = {"logs": 0, "healthy": 0, "named": 0, "cause": 0}
            for name, log in plain.items():
                log = {k: list(v) for k, v in log.items()}
                change(log)
                path = os.path.join(folder, "wrong.csv")
                write(path, log)
                said = diagnose(faultline, path, model)
                named = bool(said["faults"])
                cause = said["verdict"] in ("inconclusive", "refused") and any(
                    w in said["verdict_reason"] for w in words)
                row["logs"] += 1
                row["healthy"] += said["verdict"] == "healthy"
                row["named"] += named
                row["cause"] += cause
                if not cause or named:
                    faults = ", ".join(f"{f['kind']} {f['joint'] or '-'} at {f['onset_s']:.2f}" for f in said["faults"])
                    notes.append(f"{robot}/{name}, {what}: {said['verdict']}: {faults or said['verdict_reason']}")
            print(f"| {robot} | {what} | {row['logs']} | {row['healthy']} | {row['named']} | {row['cause']} |", flush=True)
            for key in total:
                total[key] += row[key]
    print(f"| all | | {total['logs']} | {total['healthy']} | {total['named']} | {total['cause']} |\n")
    print("\n".join(notes))


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], [arg.split("=", 1) for arg in sys.argv[3:]])
