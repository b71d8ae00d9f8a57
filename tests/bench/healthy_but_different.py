#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Healthy robots that differ from the one learned from: simulates, learns, diagnoses and prints the table.

Usage: healthy_but_different.py [ROW...]     called by healthy_but_different.sh; SEED in the environment draws
other motions and noise
"""
import concurrent.futures
import csv
import json
import os
import random
import statistics
import subprocess
import sys
import time

FAULTLINE = os.environ["FAULTLINE"]
OUT = os.path.join(os.environ["FAULTLINE_OUT"], "healthy-but-different")
SEED = int(os.environ.get("SEED", "0"))
HEALTHY_SEEDS = 4
FAULT_SEEDS = 1
PERIOD_S = 0.002
DURATION_S = 5.0
ONSET_S = 2.6137

MASSES = {"m1": 9.0, "m2": 6.0, "m3": 2.0}
VISCOUS, COULOMB = [2.5, 1.2, 15.0], [3.5, 2.2, 6.0]
RATING = [150, 80, 250]
Q_NOISE, DQ_NOISE = [5e-5, 5e-5, 1e-5], [4e-3, 4e-3, 8e-4]

# kind: size by joint, more keys
FAULTS = {
    "free_swinging": ([0, 0, 0], ""),
    "locked": ([0, 0, 0], ""),
    "torque_loss": ([0.4, 0.5, 0.4], ""),
    "sensor_bias": ([0.03, -0.03, 0.006], ""),
    "sensor_drift": ([0.05, -0.05, 0.01], ""),
    "friction_increase": ([5.0, 3.0, 9.0], ", viscous = 1.5"),
    "payload_change": ([1.0, 1.0, 1.0], ""),
    "collision": ([40.0, 25.0, 60.0], ", duration_s = 0.05"),
}


def scaled(values, by):
    return [by * v for v in values]


class Row:
    """A difference: what the simulated machine is, and what becomes of its log."""

    def __init__(self, friction=1.0, viscous=1.0, masses=1.0, noise=1.0, change=None, load=0.0, ripple_rates=()):
        self.friction, self.viscous, self.masses, self.noise, self.change = friction, viscous, masses, noise, change
        self.load, self.ripple_rates = load, ripple_rates


def column(head, name):
    return head.index(name)


def wobbling_stamps(head, rows, rng):
    for row in rows:
        row[0] = repr(float(row[0]) + rng.gauss(0.0, 0.1 * PERIOD_S))
    return rows


def lost_rows(head, rows, rng):
    return [row for row in rows if rng.random() > 0.05]


def late_torque(head, rows, rng):
    columns = [column(head, f"tau{j}") for j in (1, 2, 3)]
    for k in range(len(rows) - 1, 0, -1):
        for c in columns:
            rows[k][c] = rows[k - 1][c]
    return rows


def derived_velocity(head, rows, rng):
    for j in (1, 2, 3):
        q, dq = column(head, f"q{j}"), column(head, f"dq{j}")
        for k in range(len(rows) - 1, 0, -1):
            rows[k][dq] = repr((float(rows[k][q]) - float(rows[k - 1][q])) / PERIOD_S)
    return rows


def logged_torque(factor):
    def change(head, rows, rng):
        for row in rows:
            for j in (1, 2, 3):
                c = column(head, f"tau{j}")
                row[c] = repr(factor * float(row[c]))
        return rows
    return change


ROWS = {
    "as_learned": Row(),
    "friction_x0.7": Row(friction=0.7),
    "friction_x0.9": Row(friction=0.9),
    "friction_x1.1": Row(friction=1.1),
    "friction_x1.5": Row(friction=1.5),
    "masses_+2%": Row(masses=1.02),
    "noise_x2": Row(noise=2.0),
    "stamps_wobble": Row(change=wobbling_stamps),
    "rows_lost_5%": Row(change=lost_rows),
    "torque_one_row_late": Row(change=late_torque),
    "velocity_by_difference": Row(change=derived_velocity),
    "torque_constant_+2%": Row(change=logged_torque(1 / 1.02)),
    "torque_constant_-2%": Row(change=logged_torque(1 / 0.98)),
    "ripple_1%_of_rating": Row(ripple_rates=(8, 6, 60)),
    "cogging_1%_of_rating": Row(ripple_rates=(120, 90, 900)),
    "friction_of_load_5%": Row(load=0.05),
    "dry_x0.85_viscous_x1.2": Row(friction=0.85, viscous=1.2 / 0.85),
    "dry_x1.15_viscous_x0.8": Row(friction=1.15, viscous=0.8 / 1.15),
}


def spec_text(row, seed):
    ripples = ", ".join(f"{{joint = {j + 1}, rate = {rate}, sine = {0.01 * RATING[j]}}}"
                        for j, rate in enumerate(row.ripple_rates))
    known = ", ".join(f"{name} = {row.masses * value}" for name, value in MASSES.items())
    return f"""format = "csv"
seed = {seed}
duration_s = {DURATION_S}
sample_period_s = {PERIOD_S}
control_period_s = "held"
noise = {{q = {scaled(Q_NOISE, row.noise)}, dq = {scaled(DQ_NOISE, row.noise)}}}
controller = {{mass_error_std = 0.03}}

[limits]
torque = {RATING}
stop_low = [-2.6, -2.6, -0.36]
stop_high = [2.6, 2.6, 0.06]
overspeed = [15, 15, 3]

[motion]
low = [-2.2, -2.2, -0.3]
high = [2.2, 2.2, 0.0]
move_s = [0.9, 1.4]
dwell_s = [0.1, 0.3]

[robot]
name = "different"
axes = "RRP"
known = {{{known}, l1 = 0.4, l2 = 0.3}}
friction = {{viscous = {scaled(VISCOUS, row.viscous * row.friction)}, coulomb = {scaled(COULOMB, row.friction)}, width = 0.02, load = {row.load}}}
ripple = [{ripples}]
"""


def joint_of(kind, turn):
    return 3 if kind == "payload_change" else 1 + turn % 3


def runs_of(turn):
    """(name, kind, joint) and the spec's text of each run."""
    runs = [((f"healthy_{i}", "none", 0), "") for i in range(HEALTHY_SEEDS)]
    for i in range(FAULT_SEEDS):
        for k, (kind, (sizes, more)) in enumerate(FAULTS.items()):
            joint = joint_of(kind, turn + k + i)
            text = f'fault = {{kind = "{kind}", joint = {joint}, onset_s = {ONSET_S}'
            if sizes[joint - 1]:
                text += f", size = {sizes[joint - 1]}"
            runs.append(((f"{kind}_{i}", kind, joint), text + more + "}"))
    return runs


def run(*command):
    done = subprocess.run([FAULTLINE, *command], capture_output=True, text=True)
    if done.returncode > 1:
        sys.exit(f"healthy_but_different: {' '.join(command)}\n{done.stderr}")
    return done.stdout


def simulate(folder, row, seed, runs):
    os.makedirs(folder, exist_ok=True)
    spec = os.path.join(folder, "spec.toml")
    with open(spec, "w") as file:
        file.write(spec_text(row, seed))
        for (name, _, _), text in runs:
            file.write(f'\n[[run]]\nname = "{name}"\n{text}\n')
    run("simulate", spec, "-o", folder)
    if not row.change:
        return
    for i, ((name, _, _), _) in enumerate(runs):
        path = os.path.join(folder, name + ".csv")
        with open(path, newline="") as file:
            head, *rows = list(csv.reader(file))
        rows = row.change(head, rows, random.Random(1000 * seed + i))
        with open(path, "w", newline="") as file:
            csv.writer(file).writerows([head] + rows)


def learn_from(logs, folder, l1=0.4, held=False):
    """The model of a RRP robot of which l1 alone is known, and the seconds that learning it took."""
    with open(os.path.join(folder, "robot.toml"), "w") as file:
        file.write(f'axes = "RRP"\n\n[known]\nl1 = {l1}\n\n[log]\ntorque = "commanded"\n')
        if held:
            file.write('torque_between_samples = "held"\n')
    return learned(logs, folder)


def learned(logs, folder):
    """The model of the robot in folder/robot.toml, and the seconds that learning took."""
    robot, model = os.path.join(folder, "robot.toml"), os.path.join(folder, "model.json")
    start = time.monotonic()
    said = run("learn", *logs, "--robot", robot, "-o", model)
    learn_s = time.monotonic() - start
    with open(os.path.join(folder, "learn.txt"), "w") as out:
        out.write(said)
    return model, learn_s


def learn():
    folder = os.path.join(OUT, "learn")
    simulate(folder, Row(), 100000 * SEED + 9001, [((f"healthy_{i}", "none", 0), "duration_s = 8") for i in range(3)])
    return learn_from([os.path.join(folder, f"healthy_{i}.csv") for i in range(3)], folder, held=True)


def diagnose(path, model):
    return json.loads(run("diagnose", path, "--model", model, "--json", "-"))


def diagnose_all(paths, model):
    """The report of each log."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda path: diagnose(path, model), paths))


def said(faults):
    return ", ".join(f"{f['kind']} {f['joint']} at {f['alarm_s']:.3f}" for f in faults) or "nothing"


class Tally:
    def __init__(self):
        self.healthy = self.alarms = self.inconclusive = self.runs = self.found = self.right = self.early = 0
        self.delays = []

    def take(self, kind, joint, report):
        faults = report["faults"]
        if kind == "none":
            self.healthy += 1
            self.alarms += bool(faults)
            self.inconclusive += report["verdict"] == "inconclusive"
            return not faults
        self.runs += 1
        self.early += any(f["alarm_s"] < ONSET_S for f in faults)
        after = [f for f in faults if f["alarm_s"] >= ONSET_S]
        if not after:
            return False
        self.found += 1
        self.delays.append(after[0]["alarm_s"] - ONSET_S)
        right = after[0]["kind"] == kind and after[0]["joint"] == joint
        self.right += right
        return right

    def add(self, other):
        for key, value in vars(other).items():
            setattr(self, key, getattr(self, key) + value)

    def line(self, name):
        delay = f"{statistics.median(self.delays):.3f}" if self.delays else "-"
        return (f"| {name} | {self.alarms} of {self.healthy} | {self.inconclusive} | {self.found} of {self.runs} | "
                f"{self.right} | {self.early} | {delay} |")


def tally_of(cell, runs, paths, model):
    """The tally of a cell's (name, kind, joint, onset), and what went wrong."""
    global ONSET_S
    tally, notes = Tally(), []
    for (name, kind, joint, ONSET_S), report in zip(runs, diagnose_all(paths, model)):
        if not tally.take(kind, joint, report):
            notes.append(f"{cell}/{name}: reported {said(report['faults'])}, onset {ONSET_S:.2f}")
    return tally, notes


def main(wanted):
    unknown = [name for name in wanted if name not in ROWS]
    if unknown:
        sys.exit(f"healthy_but_different: no row {unknown[0]}; expected one of {', '.join(ROWS)}")
    model, learn_s = learn()
    print(f"Learned in {learn_s:.0f} s.\n")
    print("| healthy, but | with alarm | inconclusive | with a fault: found | right | early | median delay/s |")
    print("|---|---|---|---|---|---|---|")
    total, notes, rows, paths = Tally(), [], [], []
    for turn, (name, row) in enumerate(ROWS.items()):
        if wanted and name not in wanted:
            continue
        folder, runs = os.path.join(OUT, name), runs_of(turn)
        simulate(folder, row, 100000 * SEED + 100 * (turn + 1), runs)
        paths += [os.path.join(folder, run_name + ".csv") for (run_name, _, _), _ in runs]
        rows.append((name, runs))
    reports = iter(diagnose_all(paths, model))
    for name, runs in rows:
        tally = Tally()
        for ((run_name, kind, joint), _), report in zip(runs, reports):
            if not tally.take(kind, joint, report):
                notes.append(f"{name}/{run_name}: {kind} {joint}, reported {said(report['faults'])}")
        print(tally.line(name), flush=True)
        total.add(tally)
    print(total.line("all"))
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
