#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A mass that is added to each link in turn, of a SCARA and of a six-axis arm whose days differ.

Usage: payload_links.py [ROBOT...]     called by payload_links.sh
"""
import math
import os
import random
import statistics
import sys

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "payload-links")
SEED = int(os.environ.get("SEED", "1"))
LEARNED_DAYS, HEALTHY_DAYS, MASSES_A_LINK = 5, 6, 4
MASS_BY_DAY, FRICTION_BY_DAY = 0.004, 0.05  # standard deviations, relative

SIX_AXES = """gravity = [0, 0, -9.81]
friction = {{viscous = {viscous}, coulomb = {coulomb}, width = 0.02}}
"""
AXES = ((0, 0, 1), (0, 1, 0), (0, 1, 0), (0, 0, 1), (0, 1, 0), (0, 0, 1))
OFFSETS = ((0, 0, 0), (0.15, 0, 0.3), (0, 0, 0.4), (0.03, 0, 0.2), (0, 0, 0.2), (0.04, 0, 0.09))
SIX_AXES += "".join(f'\n[[robot.joint]]\nkind = "revolute"\naxis = {list(axis)}\noffset = {list(offset)}\n'
                    for axis, offset in zip(AXES, OFFSETS))
SIX_AXES_LINK = """
[[robot.link]]
shape = "general"
mass = {mass}
centre = {centre}
inertia = {inertia}
length = {length}
"""
LENGTHS = (0, 0, 0, 0, 0, 0.12)  # that offsets do not say: of the tip
CENTRES = ([0.02, 0, 0.2], [0, 0.03, 0.18], [0.01, 0, 0.1], [0, 0.01, 0.1], [0.02, 0, 0.05], [0.04, 0.02, 0.02])


class Scara:
    axes, period_s = "RRP", 0.002
    kilograms = ((0.4, 1.6), (0.3, 1.2), (0.2, 0.8))  # that are added, by link
    low, high = [-2.2, -2.2, -0.3], [2.2, 2.2, 0.0]
    noise = "{q = [5e-5, 5e-5, 1e-5], dq = [4e-3, 4e-3, 8e-4]}"
    limits = ("torque = [150, 80, 250]\nstop_low = [-2.6, -2.6, -0.36]\nstop_high = [2.6, 2.6, 0.06]\n"
              "overspeed = [15, 15, 3]")
    learned_as = 'axes = "RRP"\n\n[known]\nl1 = 0.4\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "held"\n'

    def body(self, by_day, viscous, coulomb):
        m1, m2, m3 = by_day([9.0, 6.0, 2.0], MASS_BY_DAY)
        return (f'axes = "RRP"\nknown = {{m1 = {m1}, m2 = {m2}, m3 = {m3}, l1 = 0.4, l2 = 0.3}}\n'
                f"friction = {{viscous = {viscous}, coulomb = {coulomb}, width = 0.02}}\n")

    viscous, coulomb = [2.5, 1.2, 15.0], [3.5, 2.2, 6.0]


class SixAxes:
    axes, period_s = "RRRRRR", 0.004
    kilograms = ((3.0, 10.0), (0.8, 3.0), (0.5, 2.0), (0.4, 1.5), (0.4, 1.2), (0.3, 1.0))
    low, high = [-1.5, -1.0, -1.2, -1.8, -1.4, -2.0], [1.5, 1.0, 1.2, 1.8, 1.4, 2.0]
    noise = "{q = 3e-5, dq = 3e-3}"
    limits = "torque = [300, 300, 200, 60, 50, 30]\noverspeed = [12, 12, 12, 15, 15, 20]"
    learned_as = None  # the robot's geometry, its links unknown
    viscous, coulomb = [4.0, 4.0, 2.5, 0.8, 0.6, 0.3], [6.0, 6.0, 4.0, 1.5, 1.2, 0.7]
    masses = [12.0, 9.0, 6.0, 3.0, 1.5, 0.8]

    def body(self, by_day, viscous, coulomb):
        text = SIX_AXES.format(viscous=viscous, coulomb=coulomb)
        for mass, centre, length in zip(by_day(self.masses, MASS_BY_DAY), CENTRES, LENGTHS):
            inertia = [mass * 0.006, mass * 0.006, mass * 0.003]
            text += SIX_AXES_LINK.format(mass=mass, centre=centre, inertia=inertia, length=length)
        return text

    def __init__(self):
        shape = SIX_AXES.format(viscous=self.viscous, coulomb=self.coulomb).replace("robot.", "")
        top, joints = shape.split("\n\n", 1)
        self.learned_as = (f'{top}\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "held"\n\n{joints}'
                           + "".join(f'\n[[link]]\nshape = "general"\nlength = {length}\n' for length in LENGTHS))


ROBOTS = {"scara": Scara, "six_axes": SixAxes}


class Cell:
    """A robot, and how its days differ."""

    def __init__(self, name):
        self.robot = ROBOTS[name]()
        self.rng = random.Random(f"{SEED} {name}")
        self.folder = os.path.join(OUT, name)

    def by_day(self, values, std):
        return [v * (1.0 + self.rng.gauss(0.0, std)) for v in values]

    def log(self, seed, name, duration_s, fault=""):
        robot = self.robot
        friction = [1.0 + self.rng.gauss(0.0, FRICTION_BY_DAY) for _ in robot.viscous]
        body = robot.body(self.by_day, [v * f for v, f in zip(robot.viscous, friction)],
                          [c * f for c, f in zip(robot.coulomb, friction)])
        folder = os.path.join(self.folder, name)
        os.makedirs(folder, exist_ok=True)
        spec = os.path.join(folder, "spec.toml")
        with open(spec, "w") as file:
            file.write(f"""format = "csv"
seed = {seed}
duration_s = {duration_s}
sample_period_s = {robot.period_s}
control_period_s = "held"
noise = {robot.noise}
controller = {{mass_error_std = 0.03}}

[limits]
{robot.limits}

[motion]
low = {robot.low}
high = {robot.high}
move_s = [0.9, 1.5]
dwell_s = [0.1, 0.4]

[robot]
name = "carrier"
{body}
[[run]]
name = "{name}"
{fault}
""")
        simulated.run("simulate", spec, "-o", folder)
        return os.path.join(folder, name + ".csv")


def judge(name):
    """Lines of the table, and what went wrong."""
    cell, base = Cell(name), 100000 * SEED + 1000 * list(ROBOTS).index(name)
    days = [cell.log(base + i, f"day_{i}", 12.0) for i in range(LEARNED_DAYS)]
    with open(os.path.join(cell.folder, "robot.toml"), "w") as file:
        file.write(cell.robot.learned_as)
    model, learn_s = simulated.learned(days, cell.folder)
    healthy = [cell.log(base + 100 + i, f"healthy_{i}", 8.0) for i in range(HEALTHY_DAYS)]
    runs, paths, notes = [], [], []
    for link, (low, high) in enumerate(cell.robot.kilograms, start=1):
        for i in range(MASSES_A_LINK):
            kg = round(low * (high / low) ** cell.rng.random(), 3)
            onset_s = round(cell.rng.uniform(2.0, 5.0), 4)
            runs.append((link, kg, onset_s))
            paths.append(cell.log(base + 200 + len(runs), f"link_{link}_{i}", 8.0,
                                  f'fault = {{kind = "payload_change", joint = {link}, onset_s = {onset_s}, size = {kg}}}'))
    false = sum(bool(report["faults"]) for report in simulated.diagnose_all(healthy, model))
    found, right, within, errors, early = 0, 0, 0, [], 0
    for (link, kg, onset_s), path, report in zip(runs, paths, simulated.diagnose_all(paths, model)):
        early += any(f["alarm_s"] < onset_s for f in report["faults"])
        after = [f for f in report["faults"] if f["alarm_s"] >= onset_s]
        found += bool(after)
        if not after or (after[0]["kind"], after[0]["joint"]) != ("payload_change", link):
            alike = [f"{o['kind']} {o['joint']}" for o in after[0]["could_also_be"]] if after else []
            notes.append(f"{os.path.basename(path)}: {kg} kg on link {link}: {simulated.said(report['faults'])}; {alike}")
            continue
        right += 1
        error = abs(after[0]["size"]["value"] / kg - 1.0)
        errors.append(error)
        within += error <= 0.15
    off = f"{100 * statistics.median(errors):.1f} %" if errors else "-"
    line = (f"| {name} | {false} of {HEALTHY_DAYS} | {found} of {len(runs)} | {right} | {early} | {within} | {off} "
            f"| {learn_s:.0f} s |")
    return line, notes


def main(wanted):
    print("| robot | healthy with alarm | with a mass: found | named with the link | early | mass within 15 % "
          "| median error | learned in |")
    print("|---|---|---|---|---|---|---|---|")
    notes = []
    for name in wanted or ROBOTS:
        line, wrong = judge(name)
        print(line, flush=True)
        notes += wrong
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
