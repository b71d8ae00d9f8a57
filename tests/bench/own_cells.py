#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Cells of robots drawn at random whose days differ, each with a trouble of its own.

Usage: own_cells.py [CELL...]     called by own_cells.sh; SEED in the environment draws other robots
"""
import math
import os
import random
import sys

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "own-cells")
SEED = int(os.environ.get("SEED", "1"))
DAYS = 6
DURATION_S = 10.0
RIPPLES = (10, 8, 60)  # a turn or a metre


class Robot:
    """A RRP robot as its maker draws it; all else is in proportion."""

    def __init__(self, rng):
        self.m = [rng.uniform(4, 12), rng.uniform(3, 8), rng.uniform(1, 3)]
        self.l = [rng.uniform(0.25, 0.5), rng.uniform(0.2, 0.4)]
        last = self.m[1] / 3 + self.m[2]
        self.inertia = [self.l[0]**2 * (self.m[0] / 3 + self.m[1] + self.m[2]) + self.l[1]**2 * last,
                        self.l[1]**2 * last, self.m[2]]
        self.rating = [60 * self.inertia[0], 60 * self.inertia[1], 60 * self.inertia[2]]
        self.coulomb = [rng.uniform(0.02, 0.05) * r for r in self.rating]
        self.viscous = [rng.uniform(0.4, 1.0) * c for c in self.coulomb[:2]] + [rng.uniform(1, 4) * self.coulomb[2]]

    def spec(self, day):
        coulomb, viscous = ([day.friction * v for v in values] for values in (self.coulomb, self.viscous))
        return (f'[robot]\nname = "cell"\naxes = "RRP"\n'
                f'known = {{m1 = {self.m[0]}, m2 = {self.m[1]}, m3 = {self.m[2] + day.tool_kg}, l1 = {self.l[0]}, '
                f'l2 = {self.l[1]}}}\n'
                f'friction = {{viscous = {viscous}, coulomb = {coulomb}, width = [0.02, 0.02, 0.005]}}\n')


class Day:
    """What differs from day to day."""

    def __init__(self, rng):
        self.friction = rng.uniform(0.8, 1.25)
        self.gain = [rng.uniform(-0.015, 0.015) for _ in range(3)]
        self.noise = rng.uniform(0.8, 1.3)
        self.tool_kg = 0.0


def springs(robot, day, rng):
    """Gears that give way, ripple, friction that warms up."""
    share, hertz = (0.3, 0.3), (28, 35)
    motor = [s * i for s, i in zip(share, robot.inertia)]
    stiffness = [m * (2 * math.pi * f)**2 for m, f in zip(motor, hertz)]
    damping = [0.1 * math.sqrt(k * m) for k, m in zip(stiffness, motor)]
    return {
        "sample_period_s": 0.002, "control_period_s": 0.001,
        "noise": {"q": [2e-5, 2e-5, 5e-6], "dq": [2e-3, 2e-3, 5e-4], "q_resolution": [5e-5, 5e-5, 1e-5]},
        "gears": {"stiffness": stiffness + [0], "damping": damping + [0], "motor_inertia": motor + [0]},
        "warm_up": {"share": 0.2, "time_s": 20.0},
        "ripple": 0.004,
    }


def pieces(robot, day, rng):
    """A work piece of 40 % of the last link that comes and goes; coarse codes."""
    return {
        "sample_period_s": 0.002, "control_period_s": 0.002,
        "noise": {"q": [2e-5, 2e-5, 5e-6], "dq": [3e-3, 3e-3, 6e-4], "q_resolution": [1e-4, 1e-4, 2e-5]},
        "work_piece": {"mass": 0.4 * robot.m[2], "carried_s": [1.0, 2.5], "empty_s": [1.0, 2.5]},
        "ripple": 0.003,
    }


def sticky(robot, day, rng):
    """Slow logs of another tool every day, friction that sticks, torque a row late."""
    day.tool_kg = rng.uniform(-0.04, 0.04) * robot.m[2]
    return {
        "sample_period_s": 0.01, "control_period_s": 0.01,
        "noise": {"q": [5e-5, 5e-5, 1e-5], "dq": [4e-3, 4e-3, 8e-4]},
        "stick_slip": {"share": 0.2, "speed": [0.05, 0.05, 0.01]},
        "recording": {"torque_late_rows": 1},
    }


def wobbly(robot, day, rng):
    """Velocity by difference of codes, stamps in milliseconds that wobble, rows lost."""
    return {
        "sample_period_s": 0.002, "control_period_s": 0.002,
        "noise": {"q": [1e-5, 1e-5, 2e-6], "q_resolution": [9.6e-5, 9.6e-5, 2e-5]},
        "recording": {"velocity": '"difference"', "jitter_s": 4e-4, "stamp_resolution_s": 0.001, "lost": 0.005},
    }


def filtered(robot, day, rng):
    """Velocity by difference of fine codes through a low pass of 10 ms, as controllers log it."""
    return {
        "sample_period_s": 0.002, "control_period_s": 0.002,
        "noise": {"q": [1e-5, 1e-5, 2e-6], "q_resolution": [2e-5, 2e-5, 5e-6]},
        "recording": {"velocity": '"difference"', "velocity_filter_s": 0.01},
    }


def counts(robot, day, rng):
    """Encoders of 2000 counts a turn of the joint, velocity by difference of them."""
    step = 2 * math.pi / 2000
    return {
        "sample_period_s": 0.002, "control_period_s": 0.002,
        "noise": {"q": [1e-5, 1e-5, 2e-6], "q_resolution": [step, step, 1e-4]},
        "recording": {"velocity": '"difference"'},
    }


CELLS = {"springs": springs, "pieces": pieces, "sticky": sticky, "wobbly": wobbly, "filtered": filtered,
         "counts": counts}

# kind: sizes by joint in shares of the rating (bias, drift: rad, m; payload: kg of the last link), more keys
FAULTS = {
    "free_swinging": None,
    "locked": None,
    "torque_loss": [0.6, 0.6, 0.6],
    "sensor_bias": [0.02, 0.02, 0.004],
    "stuck_encoder": None,
    "sensor_drift": [0.05, 0.05, 0.01],
    "friction_increase": [0.08, 0.08, 0.08],
    "collision": [0.25, 0.25, 0.25],
    "payload_change": [0, 0, 0.8],
}
OF_RATING = ("friction_increase", "collision")


def fault_text(robot, kind, joint, onset_s):
    text = f'fault = {{kind = "{kind}", joint = {joint}, onset_s = {onset_s}'
    if FAULTS[kind]:
        size = FAULTS[kind][joint - 1]
        size *= robot.rating[joint - 1] if kind in OF_RATING else robot.m[2] if kind == "payload_change" else 1.0
        text += f", size = {size}"
    return text + (", duration_s = 0.08}" if kind == "collision" else "}")


def faulty_runs(robot, rng):
    """(name, kind, joint, onset) and the spec's text of each."""
    runs = []
    for kind in FAULTS:
        for joint in (1, 2, 3):
            if kind == "payload_change" and joint < 3:
                continue
            onset = round(rng.uniform(3.0, 6.0), 4)
            runs.append(((f"{kind}_{joint}", kind, joint, onset), fault_text(robot, kind, joint, onset)))
    return runs


def toml(values):
    return "".join(f"{key} = {value}\n" for key, value in values.items())


def spec_text(robot, day, cell, rng, seed):
    trouble = cell(robot, day, rng)
    ripple = trouble.pop("ripple", 0.0)
    sections = {key: value for key, value in trouble.items() if isinstance(value, dict)}
    head = {key: value for key, value in trouble.items() if key not in sections}
    sections["noise"] = {key: [day.noise * v for v in values] if key != "q_resolution" else values
                         for key, values in sections["noise"].items()}
    sections["drives"] = {"gain": day.gain, "roughness": [0.003 * r for r in robot.rating]}
    sections["motion"] = {"low": [-2.2, -2.2, -0.3], "high": [2.2, 2.2, 0.0], "move_s": [1.0, 1.6], "dwell_s": [0.05, 0.4]}
    sections["limits"] = {"torque": robot.rating, "stop_low": [-2.8, -2.8, -0.38], "stop_high": [2.8, 2.8, 0.08]}
    sections["controller"] = {"mass_error_std": 0.03, "bandwidth_rad_s": 18.0}
    text = f'seed = {seed}\nduration_s = {DURATION_S}\n' + toml(head)
    text += "".join(f"\n[{name}]\n{toml(values)}" for name, values in sections.items())
    text += "\n" + robot.spec(day)
    if ripple:
        ripples = ", ".join(f"{{joint = {j + 1}, rate = {RIPPLES[j]}, sine = {ripple * robot.rating[j]}}}" for j in range(3))
        text += f"ripple = [{ripples}]\n"
    return text


def simulate(folder, robot, cell, seed, runs):
    paths = []
    os.makedirs(folder, exist_ok=True)
    for i, (name, text) in enumerate(runs):
        rng = random.Random(f"{seed} {i}")
        spec = os.path.join(folder, name + ".toml")
        with open(spec, "w") as file:
            file.write(spec_text(robot, Day(rng), cell, rng, 1000 * seed + i) + f'\n[[run]]\nname = "{name}"\n{text}\n')
        simulated.run("simulate", spec, "-o", folder)
        paths.append(os.path.join(folder, name + ".csv"))
    return paths


def learn(folder, robot, cell, seed):
    logs = simulate(os.path.join(folder, "learn"), robot, cell, seed, [(f"day_{i}", "") for i in range(DAYS)])
    return simulated.learn_from(logs, folder, robot.l[0])


def judge(name, seed):
    """The cell's tally, what went wrong, and how long it took to learn."""
    rng, cell = random.Random(f"{name} {SEED}"), CELLS[name]
    robot, folder = Robot(rng), os.path.join(OUT, f"{name}_{SEED}")
    model, learn_s = learn(folder, robot, cell, seed)
    runs = [((f"healthy_{i}", "none", 0, math.inf), "") for i in range(DAYS)] + faulty_runs(robot, rng)
    paths = simulate(os.path.join(folder, "test"), robot, cell, seed + 1, [(run[0][0], run[1]) for run in runs])
    tally, notes = simulated.tally_of(name, [run[0] for run in runs], paths, model)
    return tally, notes, learn_s


def main(wanted):
    unknown = [name for name in wanted if name not in CELLS]
    if unknown:
        sys.exit(f"own_cells: no cell {unknown[0]}; expected one of {', '.join(CELLS)}")
    print("| cell | with alarm | inconclusive | with a fault: found | right | early | median delay/s | learn/s |")
    print("|---|---|---|---|---|---|---|---|")
    total, notes = simulated.Tally(), []
    for i, name in enumerate(CELLS):
        if not wanted or name in wanted:
            tally, wrong, learn_s = judge(name, 100 * SEED + 10 * i)
            print(f"{tally.line(name)} {learn_s:.0f} |", flush=True)
            total.add(tally)
            notes += wrong
    print(total.line("all"))
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
