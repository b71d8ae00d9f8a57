#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Healthy logs that were altered after the robot had moved: what is said of them.

Usage: log_at_fault.py FAULTLINE OUT [SEED] [ALTERATION...]
OUT/ROBOT.json are models of sample_logs/ROBOT. Simulates healthy logs that the models did not learn from, alters each
in 13 ways at 5 random places, and prints a table; what is said of each log stands below it.
"""
import concurrent.futures
import csv
import json
import math
import os
import random
import re
import subprocess
import sys

ROBOTS = {"bench": "RRP", "industrial": "RRP", "rrpr": "RRPR"}
DURATION_S = {"bench": 20.0, "industrial": 6.0, "rrpr": 6.0}
PLACES = 5
DEGREES = 180.0 / math.pi
WIDE_RAD = 3.7       # a turning joint moves beyond half a turn to both sides
STOPPED_S = (0.4, 1.2)
CUT_S = 2.0
LATE_S = 0.025
CLOCKS = [1.001, 1.005, 1.01, 1.02, 1.05]


class Log:
    """Columns by name; `lines` are raw lines in front of a row."""

    def __init__(self, columns):
        self.columns = columns

    @property
    def time(self):
        return self.columns["t"]

    @property
    def rows(self):
        return len(self.time)

    @property
    def period(self):
        return (self.time[-1] - self.time[0]) / (self.rows - 1)

    def signals(self):
        return [name for name in self.columns if name != "t"]

    def change(self, names, function, begin=0, end=None):
        for name in names:
            values = self.columns[name]
            for i in range(begin, self.rows if end is None else end):
                values[i] = function(values[i])

    def text(self, second_header=None):
        names = list(self.columns)
        lines = [",".join(names)]
        for i in range(self.rows):
            if second_header and i == second_header[0]:
                names = second_header[1]
                lines.append(",".join(names))
            lines.append(",".join(repr(self.columns[name][i]) for name in names))
        return "\n".join(lines) + "\n"


class Case:
    """One altered log: its random place, joint and choice."""

    def __init__(self, robot, log, rng, number):
        self.axes, self.log, self.rng, self.number = ROBOTS[robot], log, rng, number
        self.joint = rng.randrange(len(self.axes)) + 1
        self.turns = self.axes[self.joint - 1] == "R"
        self.row = int(rng.uniform(0.25, 0.6) * log.rows)
        self.second_header = None

    def after(self, seconds):
        return min(self.row + max(1, round(seconds / self.log.period)), self.log.rows - 1)

    def of_joint(self, *quantities):
        return [f"{quantity}{self.joint}" for quantity in quantities]


def wrapped(case):
    turning = [j for j, axis in enumerate(case.axes, 1) if axis == "R"]
    case.joint = case.rng.choice(turning)
    case.log.change(case.of_joint("q"), lambda v: math.remainder(v, 2.0 * math.pi))
    return f"q{case.joint}"


def zeros(case):
    end = case.after(case.rng.uniform(*STOPPED_S))
    case.log.change(case.log.signals(), lambda v: 0.0, case.row, end)
    return f"rows {case.row + 1} to {end}"


def frozen(case):
    end = case.after(case.rng.uniform(*STOPPED_S))
    for name in case.log.signals():
        values = case.log.columns[name]
        values[case.row:end] = [values[case.row - 1]] * (end - case.row)
    return f"rows {case.row + 1} to {end}"


def cut(case):
    end = case.after(CUT_S)
    count = end - case.row
    for name in case.log.signals():
        del case.log.columns[name][case.row:end]
    del case.log.time[-count:]
    return f"row {case.row + 1}"


def twice(case):
    end = case.after(CUT_S)
    for name in case.log.signals():
        values = case.log.columns[name]
        case.log.columns[name] = values[:end] + values[case.row:]
    period, last = case.log.period, case.log.time[-1]
    case.log.time.extend(last + (i + 1) * period for i in range(end - case.row))
    return f"rows {case.row + 1} to {end}, again"


def other_unit(case):
    factor = DEGREES if case.turns else 1000.0
    names, factor = case.rng.choice([(case.of_joint("q", "dq"), factor), (case.of_joint("q"), factor),
                                     (case.of_joint("tau"), 1000.0)])
    case.log.change(names, lambda v: factor * v, case.row)
    return f"{'+'.join(names)} times {factor:.4g} from row {case.row + 1}"


def other_sign(case):
    names = case.rng.choice([case.of_joint("q", "dq"), case.of_joint("dq"), case.of_joint("tau")])
    case.log.change(names, lambda v: -v, case.row)
    return f"{'+'.join(names)} from row {case.row + 1}"


def swapped(case):
    other = case.rng.choice([j for j in range(1, len(case.axes) + 1) if j != case.joint])
    for quantity in ("q", "dq", "tau"):
        a, b = case.log.columns[f"{quantity}{case.joint}"], case.log.columns[f"{quantity}{other}"]
        a[case.row:], b[case.row:] = b[case.row:], a[case.row:]
    return f"joints {case.joint} and {other} from row {case.row + 1}"


def other_clock(case):
    factor = CLOCKS[case.number % len(CLOCKS)]
    case.log.change(["t"], lambda v: factor * v)
    return f"times {factor}"


def longer_positions(case):
    case.log.change([f"q{j}" for j in range(1, len(case.axes) + 1)], lambda v: 1.01 * v)
    return "times 1.01"


def late_torque(case):
    rows = max(1, round(LATE_S / case.log.period))
    for j in range(1, len(case.axes) + 1):
        values = case.log.columns[f"tau{j}"]
        case.log.columns[f"tau{j}"] = [values[0]] * rows + values[:-rows]
    return f"{rows} rows"


def reversed_joint(case):
    case.joint = case.number % len(case.axes) + 1
    case.log.change(case.of_joint("q", "dq", "tau"), lambda v: -v)
    return f"joint {case.joint}"


def second_header(case):
    names = list(case.log.columns)
    while names == list(case.log.columns):
        case.rng.shuffle(names)
    case.second_header = (case.row, names)
    return f"before row {case.row + 1}"


ALTERATIONS = [
    ("an angle wrapped at +-pi", wrapped), ("all columns zero", zeros), ("all columns frozen", frozen),
    ("2 s cut out, stamps closed", cut), ("2 s twice", twice), ("unit of a joint changes", other_unit),
    ("a sign changes", other_sign), ("two joints swapped from a row on", swapped), ("time x 1.001 to 1.05", other_clock),
    ("positions x 1.01", longer_positions), ("torque 25 ms late", late_torque), ("a reversed joint", reversed_joint),
    ("a second header", second_header),
]


def widened(text, axes):
    """The specification with turning joints that pass half a turn, and no end stops there."""
    def replace(name, value):
        nonlocal text
        match = re.search(rf"(?<![a-z_]){name} = \[([^\]]*)\]", text)
        old = match.group(1).split(",")
        new = [repr(value) if axis == "R" else part.strip() for axis, part in zip(axes, old)]
        text = text[:match.start(1)] + ", ".join(new) + text[match.end(1):]
    for name, value in (("low", -WIDE_RAD), ("high", WIDE_RAD), ("stop_low", -1e9), ("stop_high", 1e9)):
        replace(name, value)
    return text


def simulate(faultline, out, robot, seed):
    """Names of healthy logs of another seed: plain ones and wide ones."""
    with open(f"sample_logs/{robot}/spec.toml") as file:
        text = file.read().split("[[run]]")[0]
    text = re.sub(r"(?m)^seed = \d+", f"seed = {1000 * seed + 7}", text)
    text = re.sub(r"(?m)^format = .*", 'format = "csv"', text)
    text = re.sub(r"(?m)^duration_s = .*", f"duration_s = {DURATION_S[robot]}", text)
    for kind, spec in (("plain", text), ("wide", widened(text, ROBOTS[robot]))):
        folder = os.path.join(out, robot, kind)
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, "spec.toml")
        with open(path, "w") as file:
            file.write(spec + "".join(f'[[run]]\nname = "healthy_{i}"\n' for i in range(PLACES)))
        subprocess.run([faultline, "simulate", path, "-o", folder], check=True, capture_output=True)


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    return Log({name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])})


def diagnose(faultline, path, model):
    out = path + ".json"
    run = subprocess.run([faultline, "diagnose", path, "--model", model, "--json", out], capture_output=True, text=True)
    if run.returncode > 1:
        return "refused", run.stderr.strip()
    with open(out) as file:
        said = json.load(file)
    if said["faults"]:
        named = ", ".join(f"{f['kind']} {f['joint'] or '-'} at {f['onset_s']:.2f}" for f in said["faults"])
        return "faulty", named
    return said["verdict"], said["verdict_reason"]


def judge(faultline, out, seed, robot, number, place):
    """What is said of one altered log: words, and the line for the notes."""
    what, alter = ALTERATIONS[number] if number is not None else ("as recorded", None)
    kind = "wide" if alter is wrapped or (alter is None and place >= PLACES) else "plain"
    log = read(os.path.join(out, robot, kind, f"healthy_{place % PLACES}.csv"))
    case = Case(robot, log, random.Random(f"{seed} {robot} {number} {place}"), place)
    how = alter(case) if alter else kind
    path = os.path.join(out, robot, f"altered_{number}_{place}.csv")
    with open(path, "w") as file:
        file.write(log.text(case.second_header))
    verdict, reason = diagnose(faultline, path, os.path.join(out, robot + ".json"))
    return verdict, f"{robot}, {what} {place} ({how}): {verdict}: {reason}"


def main(faultline, out, seed="1", *only):
    for robot in ROBOTS:
        simulate(faultline, out, robot, int(seed))
    numbers = [int(number) - 1 for number in only] or range(len(ALTERATIONS))
    jobs = [(robot, number, place) for number in numbers for robot in ROBOTS for place in range(PLACES)]
    jobs += [(robot, None, place) for robot in ROBOTS for place in range(2 * PLACES)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        said = dict(zip(jobs, pool.map(lambda job: judge(faultline, out, seed, *job), jobs)))
    print("| alteration | " + " | ".join(f"{r}: healthy | no verdict | a fault named" for r in ROBOTS) + " |")
    print("|---|" + "---|" * (3 * len(ROBOTS)))
    total = {robot: [0, 0, 0] for robot in ROBOTS}
    for number in [None, *numbers]:
        cells = []
        for robot in ROBOTS:
            verdicts = [said[job][0] for job in jobs if job[0] == robot and job[1] == number]
            counts = [verdicts.count("healthy"), sum(v in ("inconclusive", "refused") for v in verdicts),
                      verdicts.count("faulty")]
            cells += counts
            if number is not None:
                total[robot] = [a + b for a, b in zip(total[robot], counts)]
        name = "none" if number is None else f"{number + 1} {ALTERATIONS[number][0]}"
        print(f"| {name} | " + " | ".join(map(str, cells)) + " |")
    print("| all altered | " + " | ".join(str(n) for robot in ROBOTS for n in total[robot]) + " |\n")
    print("\n".join(said[job][1] for job in jobs))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
