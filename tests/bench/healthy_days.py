#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Simulates three robots, learns them from days that are alike, and prints what is found on days that are not.

Usage: healthy_days.py [NAME...]     robots and conditions, all by default; called by healthy_days.sh; needs numpy;
SEED in the environment draws other days, motions and faults

Joints are revolute (rad, N m) or prismatic (m, N); arrays of a simulation are joint by log.
"""
import collections
import concurrent.futures
import os
import pathlib
import sys

import healthy_but_different as simulated
import numpy as np

OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "healthy-days"
SEED = int(os.environ.get("SEED", "0"))
LENGTH_S, CONTROL_S, SUBSTEPS = 10.0, 0.001, 4
LOOP_RATE, LOCK_RATE = 25.0, 250.0  # rad/s, of the position loop, of the stiff spring that holds a locked joint
LEARNED_DAYS, HEALTHY_DAYS, FAULTY_DAYS = 4, 4, 2
BEFORE_S, AFTER_S = 0.3, 1.5  # a finding belongs to a fault if it begins that near to the fault's onset
NAMES = {"locked": ("locked", "stuck_encoder"), "unknown": ("unknown",), "payload_change": ("payload_change",),
         "friction_increase": ("friction_increase",)}
KINDS, MOST_NOTES = list(NAMES), 40
LEVEL = (0.0, 0.0, 9.81)  # m/s^2, what holds a mass up against gravity, along three axes of the machine


def scara_equations(q, dq, payload, up):
    """Mass matrix, and the force of velocities and gravity, of two revolute joints and a vertical prismatic one."""
    arm, forearm, quill = 0.35, 0.3, 3 + payload  # m, m, kg
    coupling = 5 * arm * 0.15 + quill * arm * forearm
    outer = 0.05 + 5 * 0.15**2 + quill * forearm**2
    inner = 0.15 + 8 * 0.17**2 + 5 * (arm**2 + 0.15**2) + quill * (arm**2 + forearm**2)
    cosine, sine, zero = np.cos(q[1]), np.sin(q[1]), np.zeros_like(q[1])
    both = outer + coupling * cosine
    moment_1, moment_2 = 8 * 0.17 + (5 + quill) * arm, 5 * 0.15 + quill * forearm
    weight_2 = moment_2 * (np.cos(q[0] + q[1]) * up[1] - np.sin(q[0] + q[1]) * up[0])
    weight_1 = weight_2 + moment_1 * (np.cos(q[0]) * up[1] - np.sin(q[0]) * up[0])
    return ([[inner + 2 * coupling * cosine, both, zero], [both, outer + zero, zero], [zero, zero, quill + zero]],
            [weight_1 - coupling * sine * (2 * dq[0] + dq[1]) * dq[1], weight_2 + coupling * sine * dq[0]**2,
             quill * up[2] + zero])


def arm_equations(q, dq, payload, up):
    """The same of two revolute joints in a vertical plane."""
    arm, forearm = 0.4, 0.35  # m
    coupling = 4 * arm * 0.17 + payload * arm * forearm
    outer = 0.05 + 4 * 0.17**2 + payload * forearm**2
    inner = 0.15 + 6 * 0.2**2 + 4 * (arm**2 + 0.17**2) + payload * (arm**2 + forearm**2)
    cosine, sine = np.cos(q[1]), np.sin(q[1])
    both, zero = outer + coupling * cosine, np.zeros_like(q[1])
    moment_1, moment_2 = 6 * 0.2 + (4 + payload) * arm, 4 * 0.17 + payload * forearm
    weight_2 = moment_2 * (np.cos(q[0] + q[1]) * up[2] - np.sin(q[0] + q[1]) * up[0])
    weight_1 = weight_2 + moment_1 * (np.cos(q[0]) * up[2] - np.sin(q[0]) * up[0])
    return ([[inner + 2 * coupling * cosine, both], [both, outer + zero]],
            [weight_1 - coupling * sine * (2 * dq[0] + dq[1]) * dq[1], weight_2 + coupling * sine * dq[0]**2])


def gantry_equations(q, dq, payload, up):
    """The same of two horizontal prismatic joints and a vertical revolute one, whose load lies beside its axis."""
    moment, inertia = 4 * 0.08, 0.03 + 4 * 0.08**2  # kg m, kg m^2
    cosine, sine, zero = np.cos(q[2]), np.sin(q[2]), np.zeros_like(q[2])
    bridge, carriage = 59 + payload, 19 + payload  # kg
    return ([[bridge + zero, zero, -moment * sine], [zero, carriage + zero, moment * cosine],
             [-moment * sine, moment * cosine, inertia + zero]],
            [-moment * cosine * dq[2]**2 + bridge * up[0], carriage * up[1] - moment * sine * dq[2]**2,
             moment * (cosine * up[1] - sine * up[0])])


ROBOTS = {
    "scara": {
        "file": 'axes = "RRP"\n[known]\nl1 = 0.35\n', "equations": scara_equations, "rows_ms": 4, "slowness": 1.0,
        "drive_inertia": [0.5, 0.2, 2.0], "viscous": [2.0, 0.8, 20.0], "dry": [5.0, 2.0, 4.0],
        "dry_width": [0.01, 0.01, 0.003], "limit": [90.0, 40.0, 80.0], "usual": [60.0, 22.0, 45.0], "payload": 1.5,
        "low": [-1.2, -1.6, -0.15], "high": [1.2, 1.6, 0.0], "least_move": [0.35, 0.35, 0.03],
        "encoder_step": [1e-5, 1e-5, 2e-6], "speed_noise": [5e-4, 5e-4, 1e-4]},
    "arm": {
        "file": 'axes = "RR"\ngravity = [0, -9.81, 0]\n[known]\nl1 = 0.4\n', "equations": arm_equations, "rows_ms": 10,
        "slowness": 1.0, "drive_inertia": [0.4, 0.15], "viscous": [2.0, 0.8], "dry": [4.0, 1.5],
        "dry_width": [0.01, 0.01], "limit": [110.0, 40.0], "usual": [60.0, 18.0], "payload": 1.2, "low": [-0.3, -1.8],
        "high": [1.6, 1.8], "least_move": [0.35, 0.35], "encoder_step": [1e-5, 1e-5], "speed_noise": [5e-4, 5e-4]},
    "gantry": {
        "file": 'link = [{shape = "point"}, {shape = "point"}, {shape = "general"}]\njoint = [{kind = "prismatic", '
                'axis = [1, 0, 0]}, {kind = "prismatic", axis = [0, 1, 0]}, {kind = "revolute", axis = [0, 0, 1]}]\n',
        "equations": gantry_equations, "rows_ms": 4, "slowness": 1.3, "drive_inertia": [10.0, 5.0, 0.02],
        "viscous": [40.0, 20.0, 0.04], "dry": [25.0, 12.0, 0.15], "dry_width": [0.004, 0.004, 0.01],
        "limit": [900.0, 300.0, 8.0], "usual": [480.0, 130.0, 2.5], "payload": 8.0,
        "low": [0.0, 0.0, -1.5], "high": [1.0, 0.6, 1.5], "least_move": [0.15, 0.1, 0.5],
        "encoder_step": [2e-6, 2e-6, 2e-5], "speed_noise": [1e-4, 1e-4, 1e-3]}}
for made in ROBOTS.values():
    made.update({key: np.array(numbers) for key, numbers in made.items() if isinstance(numbers, list)})


# What differs from the nominal robot: for each joint, drawn about a centre and at most that far from it each day,
DAY_BY_JOINT = {
    "viscous": (1, 0.05), "dry": (1, 0.03),  # shares of the nominal friction
    "gain": (1, 0.003), "offset": (0, 0.002),  # torque given by torque asked for, and beyond, share of the usual torque
    "direction": (0, 0)}  # dry friction forth is 1 + direction, back 1 - direction
# and for the day: viscous friction that decays (share, s), mounting (rad), speed of the motion, and the log's torque
# (rows late) and stamps (share of the sample period)
DAY = {"warm_up": 0, "warm_up_s": 10, "tilt": 0, "tilt_direction": 0, "speed": 1, "rows_late": 0, "wobble": 0}
# joint from 1, 0 for a payload, which every joint feels; rate in rad/s, of an unknown torque that oscillates
Fault = collections.namedtuple("Fault", "kind joint onset_s size rate")
Log = collections.namedtuple("Log", "path condition day fault random")


def drawn(random, joints, most):
    """Numbers within most of 0: at the bounds as often as between."""
    return most * np.where(random.random(joints) < 0.5, random.choice([-1, 1], joints), random.uniform(-1, 1, joints))


CONDITIONS = {
    "as_learned": lambda random, joints: {},
    "viscous_30%_dry_15%": lambda random, joints: {"viscous": 1 + drawn(random, joints, 0.3),
                                                   "dry": 1 + drawn(random, joints, 0.15)},
    "direction_10%": lambda random, joints: {"direction": drawn(random, joints, 0.1)},
    "warm_up_15%": lambda random, joints: {"warm_up": 0.15, "warm_up_s": random.uniform(4, 15)},
    "warm_up_30%": lambda random, joints: {"warm_up": 0.30, "warm_up_s": random.uniform(4, 15)},
    "tilt_0.2_degrees": lambda random, joints: {"tilt": np.radians(0.2), "tilt_direction": random.uniform(0, 6.28)},
    "torque_gain_1%": lambda random, joints: {"gain": 1 + drawn(random, joints, 0.01)},
    "torque_offset_1%": lambda random, joints: {"offset": drawn(random, joints, 0.01)},
    "half_speed": lambda random, joints: {"speed": 0.5},
    "torque_1_row_late": lambda random, joints: {"rows_late": 1},
    "stamps_wobble_10%": lambda random, joints: {"wobble": 0.1},
    "all_but_warm_up": lambda random, joints: {
        key: value for name, change in CONDITIONS.items() if not name.startswith(("all", "warm_up"))
        for key, value in change(random, joints).items()}}


def day_of(condition, random, joints):
    """A day like those that were learned, changed by the condition."""
    alike = {key: centre + most * random.uniform(-1, 1, joints) for key, (centre, most) in DAY_BY_JOINT.items()}
    return {**DAY, **alike, **CONDITIONS[condition](random, joints)}


def fault_of(kind, random, robot):
    joint, usual = int(random.integers(len(robot["usual"]))), robot["usual"]
    size = {"locked": 1.0, "unknown": random.uniform(0.15, 0.3) * usual[joint],
            "payload_change": random.uniform(0.7, 1.3) * robot["payload"],
            "friction_increase": random.uniform(0.12, 0.3) * usual[joint]}[kind]
    return Fault(kind, 0 if kind == "payload_change" else joint + 1, random.uniform(0.42, 0.65) * LENGTH_S, size,
                 2 * np.pi * random.uniform(3, 7))


def motion(random, robot, speed):
    """Quintic moves between random places: positions, velocities and accelerations, step by joint."""
    low, span, steps = robot["low"], robot["high"] - robot["low"], round(LENGTH_S / CONTROL_S) + 1
    q, dq, ddq = (np.zeros((steps, len(low))) for _ in range(3))
    place, step = low + span * random.random(len(low)), 0
    while step < steps:
        way = np.zeros(len(low))
        while not all(abs(way) > robot["least_move"]):
            way = low + span * random.random(len(low)) - place
        length_s = max(random.uniform(0.5, 1.1), robot["slowness"] * max(abs(way) / span)) / speed
        s = np.arange(int(length_s / CONTROL_S)) * CONTROL_S / length_s
        end = min(step + len(s), steps)
        q[step:end] = (place + np.outer(10 * s**3 - 15 * s**4 + 6 * s**5, way))[:end - step]
        dq[step:end] = np.outer((30 * s**2 - 60 * s**3 + 30 * s**4) / length_s, way)[:end - step]
        ddq[step:end] = np.outer((60 * s - 180 * s**2 + 120 * s**3) / length_s**2, way)[:end - step]
        place, step = place + way, end
        q[step:] = place
        step += int(random.uniform(0.05, 0.25) / speed / CONTROL_S)
    return q, dq, ddq


class Machine:
    """A robot on all its days side by side."""

    def __init__(self, robot, logs):
        self.robot = {key: value[:, None] if isinstance(value, np.ndarray) else value for key, value in robot.items()}
        self.day = {key: np.array([log.day[key] for log in logs]).T for key in logs[0].day}
        tilt, direction = self.day["tilt"], self.day["tilt_direction"]
        self.up = LEVEL[2] * np.array([np.sin(tilt) * side for side in (np.cos(direction), np.sin(direction))] +
                                      [np.cos(tilt)])
        shape = (len(robot["viscous"]), len(logs))
        self.onset_s = np.array([log.fault.onset_s if log.fault else np.inf for log in logs])
        self.rate = np.array([log.fault.rate if log.fault else 1.0 for log in logs])
        self.size = {kind: np.zeros(shape) for kind in KINDS}
        for i, log in enumerate(logs):
            if log.fault:
                self.size[log.fault.kind][log.fault.joint - 1, i] = log.fault.size
        self.held, self.place = np.zeros(shape, bool), np.zeros(shape)
        middle = np.broadcast_to((self.robot["low"] + self.robot["high"]) / 2, shape)
        matrix, _ = robot["equations"](middle, np.zeros(shape), 0, LEVEL)
        self.inertia = np.array([matrix[i][i] for i in range(shape[0])]) + self.robot["drive_inertia"]

    def friction(self, dq, time_s, begun):
        warm = 1 + self.day["warm_up"] * np.exp(-time_s / self.day["warm_up_s"])
        side = np.tanh(dq / self.robot["dry_width"])
        dry = self.robot["dry"] * self.day["dry"] * (1 + self.day["direction"] * side)
        return (self.robot["viscous"] * self.day["viscous"] * warm * dq +
                (dry + self.size["friction_increase"] * begun) * side)

    def accelerations(self, q, dq, torque, time_s):
        begun = time_s >= self.onset_s
        payload = self.size["payload_change"][-1] * begun
        matrix, force = self.robot["equations"](q, dq, payload, self.up)
        matrix = np.array(matrix).transpose(2, 0, 1) + np.diag(self.robot["drive_inertia"][:, 0])
        acts = torque * self.day["gain"] + self.day["offset"] * self.robot["usual"] - self.friction(dq, time_s, begun)
        if begun.any():
            since_s = np.where(begun, time_s - self.onset_s, 0)
            acts += self.size["unknown"] * np.sin(self.rate * since_s)
            acts -= self.held * self.inertia * (LOCK_RATE**2 * (q - self.place) + 2 * LOCK_RATE * dq)
        return np.linalg.solve(matrix, (acts - np.array(force)).T[:, :, None])[:, :, 0].T

    def lock(self, q, time_s):
        newly = (self.size["locked"] > 0) & (time_s >= self.onset_s) & ~self.held
        self.place = np.where(newly, q, self.place)
        self.held |= newly

    def asked(self, q, dq, want, want_speed, want_acceleration):
        """The controller's torque: the nominal robot's for the wanted acceleration and what is missing."""
        matrix, force = self.robot["equations"](q, dq, 0, LEVEL)
        wish = want_acceleration + LOOP_RATE**2 * (want - q) + 2 * LOOP_RATE * (want_speed - dq)
        torque = np.array([sum(inertia * a for inertia, a in zip(row, wish)) for row in matrix]) + np.array(force)
        torque += self.robot["drive_inertia"] * wish + self.robot["viscous"] * want_speed
        torque += self.robot["dry"] * np.tanh(want_speed / self.robot["dry_width"] / 3)
        return np.clip(torque, -self.robot["limit"], self.robot["limit"])


def run(robot, logs):
    """Position, velocity and commanded torque of each log, each step by joint."""
    machine = Machine(robot, logs)
    motions = [motion(log.random, robot, log.day["speed"]) for log in logs]
    want, want_speed, want_acceleration = (np.stack([each[i] for each in motions], axis=2) for i in range(3))
    noise, speed_noise = (np.stack([log.random.standard_normal(want.shape[:2]) for log in logs], axis=2)
                          for _ in range(2))
    encoder_step = machine.robot["encoder_step"]
    q, dq, h, rows = want[0].copy(), want_speed[0].copy(), CONTROL_S / SUBSTEPS, []
    for k in range(len(want)):
        machine.lock(q, k * CONTROL_S)
        read = encoder_step * np.round(q / encoder_step + 0.7 * noise[k])
        read_speed = dq + machine.robot["speed_noise"] * speed_noise[k]
        torque = machine.asked(read, read_speed, want[k], want_speed[k], want_acceleration[k])
        rows.append(np.concatenate([read, read_speed, torque]))
        for substep in range(SUBSTEPS):  # Runge-Kutta of second order
            time_s = k * CONTROL_S + substep * h
            first = machine.accelerations(q, dq, torque, time_s)
            middle_speed = dq + 0.5 * h * first
            second = machine.accelerations(q + 0.5 * h * dq, middle_speed, torque, time_s + 0.5 * h)
            q, dq = q + h * middle_speed, dq + h * second
    return np.stack(rows).transpose(2, 0, 1)


def write(values, log, robot):
    joints, rows = len(robot["viscous"]), values[::robot["rows_ms"]].copy()
    if log.day["rows_late"]:
        rows[log.day["rows_late"]:, 2 * joints:] = rows[:-log.day["rows_late"], 2 * joints:].copy()
    period_s = robot["rows_ms"] * CONTROL_S
    stamps = period_s * (np.arange(len(rows)) + log.day["wobble"] * log.random.standard_normal(len(rows)))
    head = ["t"] + [channel + str(j + 1) for channel in ("q", "dq", "tau") for j in range(joints)]
    np.savetxt(log.path, np.column_stack([stamps, rows]), delimiter=",", header=",".join(head), comments="",
               fmt=["%.6f"] + ["%.8f"] * joints + ["%.6f"] * joints + ["%.5f"] * joints)


def prepared(robot_name, conditions):
    """Simulates and learns a robot: its model, and the logs that shall be diagnosed."""
    robot, folder, number = ROBOTS[robot_name], OUT / robot_name, list(ROBOTS).index(robot_name)
    folder.mkdir(parents=True, exist_ok=True)
    logs = []
    for turn, condition in enumerate(["as_learned", *CONDITIONS]):  # first the days that are learned
        if turn and condition not in conditions:
            continue
        for i in range(HEALTHY_DAYS + FAULTY_DAYS if turn else LEARNED_DAYS):
            random, faulty = np.random.default_rng([SEED, number, turn, i]), turn and i >= HEALTHY_DAYS
            day = day_of(condition, random, len(robot["usual"]))
            kind = KINDS[(FAULTY_DAYS * turn + i + number) % len(KINDS)]
            name = f"{condition if turn else 'learned'}_{kind if faulty else 'healthy'}_{i}.csv"
            logs.append(Log(folder / name, condition, day, fault_of(kind, random, robot) if faulty else None, random))
    for values, log in zip(run(robot, logs), logs):
        write(values, log, robot)
    (folder / "robot.toml").write_text(f'name = "{robot_name}"\n{robot["file"]}[log]\ntorque = "commanded"\n')
    model, _ = simulated.learned([str(log.path) for log in logs[:LEARNED_DAYS]], folder)
    return model, logs[LEARNED_DAYS:]


def judged(log, report):
    """Counts: with alarm, healthy, inconclusive; found, with a fault, right kind, early findings, findings more.

    A finding without a joint, as unknown faults are reported, counts for every joint.
    """
    findings, fault = report["faults"], log.fault
    if not fault:
        return np.array([bool(findings), 1, report["verdict"] == "inconclusive", 0, 0, 0, 0, 0])
    hits = [f for f in findings if (not fault.joint or f["joint"] in (fault.joint, None)) and
            -BEFORE_S <= f["onset_s"] - fault.onset_s <= AFTER_S]
    return np.array([0, 0, 0, bool(hits), 1, any(f["kind"] in NAMES[fault.kind] for f in hits),
                     sum(f["onset_s"] < fault.onset_s - BEFORE_S for f in findings), len(findings) - bool(hits)])


def line(robot_name, condition, counts):
    return f"| {robot_name} | {condition} | " + "{} of {} | {} | {} of {} | {} | {} | {} |".format(*counts)


def note(log, findings):
    truth = f"joint {log.fault.joint or 'any'} at {log.fault.onset_s:.2f}, " if log.fault else ""
    said = ", ".join(f"{f['kind']} {f['joint'] or 'of no joint'} at {f['onset_s']:.2f}" for f in findings) or "nothing"
    return f"{log.path.parent.name}/{log.path.stem}: {truth}reported {said}"


def main(wanted):
    unknown = [name for name in wanted if name not in (*ROBOTS, *CONDITIONS)]
    if unknown:
        sys.exit(f"healthy_days: no {unknown[0]}; expected some of {', '.join((*ROBOTS, *CONDITIONS))}")
    robots, conditions = ([name for name in names if name in wanted] or list(names) for names in (ROBOTS, CONDITIONS))
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        ready = list(pool.map(prepared, robots, [conditions] * len(robots)))
    print("| robot | condition | healthy with alarm | inconclusive | faults found | right kind | early | more |")
    print("|---|---|---|---|---|---|---|---|")
    notes, sums = [], []
    for robot_name, (model, logs) in zip(robots, ready):
        counts = dict.fromkeys(conditions, 0)
        for log, report in zip(logs, simulated.diagnose_all([str(log.path) for log in logs], model)):
            count = judged(log, report)
            counts[log.condition] = counts[log.condition] + count
            if count[0] or count[4] > count[5] or count[7]:
                notes.append(note(log, report["faults"]))
        for condition in conditions:
            print(line(robot_name, condition, counts[condition]), flush=True)
        sums.append(sum(counts.values()))
    for robot_name, counts in zip([*robots, "all"], [*sums, sum(sums)]):
        print(line(robot_name, "all", counts))
    print("", *notes[:MOST_NOTES], *[f"and {len(notes) - MOST_NOTES} more"][:len(notes) > MOST_NOTES], sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
