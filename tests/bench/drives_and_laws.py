#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Simulates two robots with commanded and measured torque, learns them, and prints what is found of two faults in a log.

Usage: drives_and_laws.py [SEED...]     called by drives_and_laws.sh; needs numpy
"""
import json
import math
import os
import pathlib
import subprocess
import sys

import numpy as np

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "drives-and-laws"
FIRST_S, SECOND_S, LENGTH_S = 4.0, 9.0, 15.0
NEAR_S = 0.6  # between the onset of a fault and that of its finding

SCARA = {
    "file": 'axes = "RRP"', "axes": "RRP", "period": 1e-3, "substeps": 4, "low": [-1.4, -1.8, -.12], "high": [1.4, 1.8, .12],
    "speed": [3, 4, .7], "acceleration": [10, 16, 6], "viscous": [2., 1.2, 15.], "coulomb": [4., 2.2, 6.],
    "stribeck": [1.3, 1.3, 1.25], "stribeck_speed": [.08, .1, .02], "lag": [.003, .003, .002],
    "ripple": [.012, .012, .01], "ripple_rate": [24, 24, 300], "torque_step": [.02, .01, .05],
    "encoder_step": [2e-5, 2e-5, 2e-6], "torque_noise": [.12, .06, .3], "torque_offset": [.15, .08, .4],
    "kp": [6000, 1900, 9000], "kd": [200, 60, 260], "feed_inertia": [3.6, .62, 4.2], "feed_friction": [2, 1.2, 15.],
    "feed_weight": [0, 0, 4.1 * 9.81], "limit": [74, 29, 90]}
GANTRY = {
    "file": 'joint = [{kind = "prismatic", axis = [1, 0, 0]}, {kind = "prismatic", axis = [0, 1, 0]}]',
    "axes": "PP", "period": 2e-3, "substeps": 8, "low": [-.5, -.4], "high": [.5, .4], "speed": [1.4, 1.8],
    "acceleration": [7, 10], "viscous": [45., 22.], "coulomb": [18., 9.], "stribeck": [1.3, 1.3],
    "stribeck_speed": [.02, .02], "lag": [.004, .003], "ripple": [.015, .01], "ripple_rate": [200, 240],
    "torque_step": [.08, .05], "encoder_step": [2e-6, 2e-6], "torque_noise": [.5, .3], "torque_offset": [.8, .5],
    "kp": [22 * 900, 26 * 360], "kd": [900, 360], "feed_inertia": [17., 6.], "feed_friction": [40, 20.],
    "feed_weight": [0, 0], "limit": [200, 100]}
ROBOTS = {"scara": SCARA, "gantry": GANTRY}

# Sizes by robot: the torque of an offset and of a pulse, the share that a drive gives, a push, an offset of an encoder.
SIZES = {"scara": (6, 12, .6, 30, .03), "gantry": (25, 50, .7, 140, .006)}


def faults_of(robot):
    """The first and the second fault of a log: (kind, from, until, joint, size), joints from 0, -1 for all."""
    offset, pulse, share, push, shift = SIZES[robot]
    first = {
        "none": [], "sensor offset": [("sensor", FIRST_S, 99, 0, offset)], "all gains halved": [("gains", FIRST_S, 99, -1, .5)],
        "gains of joint 1": [("gains", FIRST_S, 99, 0, .5)], "gains of joint 1 for 2 s": [("gains", FIRST_S, FIRST_S + 2, 0, .5)],
        "pulse of .3 s": [("pulse", FIRST_S, FIRST_S + .3, 0, pulse)], "drive loses torque": [("drive", FIRST_S, 99, 0, share)],
        "drive loses torque for 2 s": [("drive", FIRST_S, FIRST_S + 2, 0, share)]}
    second = {
        ("locked", 2): ("lock", SECOND_S, SECOND_S + 1, 1, 0), ("sensor_bias", 2): ("encoder", SECOND_S, 99, 1, shift),
        ("friction_increase", 2): ("friction", SECOND_S, 99, 1, 2), ("friction_increase", 1): ("friction", SECOND_S, 99, 0, 2),
        ("collision", 2): ("push", SECOND_S, SECOND_S + .12, 1, push)}
    return first, second


def motion(robot, random, steps):
    """Quintic moves between random places: positions, velocities and accelerations by step."""
    low, high, period = np.array(robot["low"]), np.array(robot["high"]), robot["period"]
    place = (low + high) / 2
    q, dq, ddq = np.tile(place, (steps, 1)), np.zeros((steps, len(low))), np.zeros((steps, len(low)))
    k = int(.3 / period)
    while k < steps:
        target = low + (high - low) * random.random(len(low))
        way = target - place
        length = max(.25, *(abs(way) * 1.875 / robot["speed"]), *np.sqrt(abs(way) * 5.77 / robot["acceleration"]))
        s = np.arange(1, int(length / period) + 1) / int(length / period)
        end = min(k + len(s), steps)
        q[k:end] = (place + np.outer(10 * s**3 - 15 * s**4 + 6 * s**5, way))[:end - k]
        dq[k:end] = np.outer((30 * s**2 - 60 * s**3 + 30 * s**4) / length, way)[:end - k]
        ddq[k:end] = np.outer((60 * s - 180 * s**2 + 120 * s**3) / length**2, way)[:end - k]
        place, k = target, end
        q[k:] = place
        k += int(.25 * (.3 + 1.4 * random.random()) / period)
    return q, dq, ddq


def accelerations(robot, q, dq, force, locked):
    if robot["axes"] == "PP":
        return [force[0] / 17.1, force[1] / 5.6]
    c, s = math.cos(q[1]), math.sin(q[1])
    m11, m12, m22 = 2.702 + 2 * .792 * c, .519 + .792 * c, .639
    r1 = force[0] + .792 * s * (2 * dq[0] * dq[1] + dq[1] ** 2)
    r2 = force[1] - .792 * s * dq[0] ** 2
    if locked[0] or locked[1]:
        return [0. if locked[0] else r1 / m11, 0. if locked[1] else r2 / m22, force[2] / 4.1 - 9.81]
    d = m11 * m22 - m12 * m12
    return [(m22 * r1 - m12 * r2) / d, (m11 * r2 - m12 * r1) / d, force[2] / 4.1 - 9.81]


def simulated(robot, seed, length_s, faults=()):
    """Rows of time, then by joint: position, velocity, commanded torque, measured torque, both references."""
    n, period, substeps = len(robot["axes"]), robot["period"], robot["substeps"]
    random, of_day = np.random.default_rng(seed), np.random.default_rng(7000 + seed)
    want, want_speed, want_acceleration = motion(robot, random, int(length_s / period))
    viscous = np.array(robot["viscous"]) * (1 + .15 * of_day.uniform(-1, 1, n))
    coulomb = np.array(robot["coulomb"]) * (1 + .12 * of_day.uniform(-1, 1, n))
    sensor_gain, sensor_offset = 1 + .006 * of_day.normal(size=n), robot["torque_offset"] * of_day.normal(size=n)
    drive_gain = 1 + .004 * of_day.normal(size=n)
    noise = robot["torque_noise"] * random.normal(size=want.shape)
    q, dq, given, speed, last = list(want[0]), [0.] * n, list(robot["feed_weight"]), [0.] * n, list(want[0])
    h, rows = period / substeps, []
    for k in range(len(want)):
        t = k * period
        now = {kind: [neutral] * n for kind, neutral in
               (("drive", 1.), ("pulse", 0.), ("sensor", 0.), ("gains", 1.), ("friction", 1.), ("push", 0.), ("encoder", 0.),
                ("lock", False))}
        for kind, begin, end, joint, size in faults:
            for i in range(n):
                if begin <= t < end and joint in (i, -1):
                    now[kind][i] = True if kind == "lock" else size
        read = [round((q[i] + now["encoder"][i]) / robot["encoder_step"][i]) * robot["encoder_step"][i] for i in range(n)]
        speed = [speed[i] + .35 * ((read[i] - last[i]) / period - speed[i]) for i in range(n)]
        last, asked, measured = read, [], [0.] * n
        for i in range(n):
            torque = now["gains"][i] * (robot["kp"][i] * (want[k, i] - read[i]) + robot["kd"][i] * (want_speed[k, i] - speed[i]))
            torque += (robot["feed_inertia"][i] * want_acceleration[k, i] + robot["feed_friction"][i] * want_speed[k, i] +
                       robot["feed_weight"][i])
            torque = max(-robot["limit"][i], min(robot["limit"][i], torque))
            asked.append(round(torque / robot["torque_step"][i]) * robot["torque_step"][i])
        for _ in range(substeps):
            force = []
            for i in range(n):
                given[i] += h / robot["lag"][i] * (asked[i] * now["drive"][i] - given[i])
                acts = given[i] * drive_gain[i] * (1 + robot["ripple"][i] * math.cos(robot["ripple_rate"][i] * q[i]))
                acts += now["pulse"][i]
                measured[i] += acts / substeps
                dry = coulomb[i] * (1 + (robot["stribeck"][i] - 1) * math.exp(-(dq[i] / robot["stribeck_speed"][i]) ** 2))
                dry *= math.tanh(dq[i] / .008)
                push = now["push"][i] * math.sin(math.pi * (t - SECOND_S) / .12)
                force.append(acts + push - now["friction"][i] * (viscous[i] * dq[i] + dry))
            for i, a in enumerate(accelerations(robot, q, dq, force, now["lock"])):
                dq[i] = 0. if now["lock"][i] else dq[i] + h * a
                q[i] += h * dq[i]
        sensed = [sensor_gain[i] * measured[i] + sensor_offset[i] + now["sensor"][i] + noise[k, i] for i in range(n)]
        rows.append([t, *read, *speed, *asked, *sensed, *want[k], *want_speed[k]])
    return np.array(rows)


def written(rows, name, robot, torque):
    commanded, measured = ("tau", "tau_meas") if torque == "commanded" else ("tau_ref", "tau")
    names = [channel + str(i + 1) for channel in ("q", "dq", commanded, measured, "q_ref", "dq_ref")
             for i in range(len(robot["axes"]))]
    path = OUT / f"{name}_{torque}.csv"
    np.savetxt(path, rows, fmt="%.7g", delimiter=",", header=",".join(["t", *names]), comments="")
    return path


def diagnosed(log, model):
    report = log.with_suffix(".json")
    subprocess.run([FAULTLINE, "diagnose", str(log), "--model", str(model), "--json", str(report)],
                   stdout=subprocess.DEVNULL, check=False)
    return json.loads(report.read_text())["faults"]


def is_first(name, fault):
    if abs(fault["onset_s"] - FIRST_S) > NEAR_S:
        return False
    if "gains" in name:
        return fault["kind"] == "unknown"
    kinds = {"sensor offset": ("unknown", "torque_sensor_error"), "pulse of .3 s": ("unknown",)}
    return fault["joint"] == 1 and fault["kind"] in kinds.get(name, ("torque_loss",))


def judged(robot_name, torque, model, seeds, logs):
    first, second = faults_of(robot_name)
    for number, name in enumerate(first):
        count = found_first = found = named = more = 0
        for label in second:
            for seed in seeds:
                log = written(logs[name, label, seed], f"{robot_name}_{number}_{label[0]}{label[1]}_{seed}",
                              ROBOTS[robot_name], torque)
                faults = diagnosed(log, model)
                at_second = [f for f in faults if f["joint"] == label[1] and abs(f["onset_s"] - SECOND_S) < NEAR_S]
                count += 1
                found_first += any(is_first(name, f) for f in faults)
                found += bool(at_second)
                named += any(f["kind"] == label[0] for f in at_second)
                more += max(0, len(faults) - (1 if name == "none" else 2))
        right = "-" if name == "none" else f"{found_first} of {count}"
        print(f"| {robot_name}, {torque} | {name} | {right} | {found} of {count} | {named} | {more} |", flush=True)


def main(seeds):
    OUT.mkdir(parents=True, exist_ok=True)
    print("| robot, torque of the balance | first fault, 4 s | right | second fault, 9 s: found | named | findings more |")
    print("|---|---|---|---|---|---|")
    for robot_name, robot in ROBOTS.items():
        first, second = faults_of(robot_name)
        logs = {(name, label, seed): simulated(robot, seed, LENGTH_S, [*faults, second[label]])
                for name, faults in first.items() for label in second for seed in seeds}
        days = [simulated(robot, 100 + day, 12. + day % 3) for day in range(1, 12)]
        for torque in ("commanded", "measured"):
            file = OUT / f"{robot_name}_{torque}.toml"
            file.write_text(f'{robot["file"]}\n[log]\ntorque = "{torque}"\n')
            paths = [written(day, f"{robot_name}_day{k}", robot, torque) for k, day in enumerate(days)]
            model = OUT / f"{robot_name}_{torque}.model"
            subprocess.run([FAULTLINE, "learn", *map(str, paths[:5]), "--robot", str(file), "-o", str(model)],
                           stdout=subprocess.DEVNULL, check=True)
            alarms = sum(bool(diagnosed(path, model)) for path in paths[5:])
            print(f"| {robot_name}, {torque} | healthy days: {alarms} of {len(paths) - 5} with alarm | | | | |", flush=True)
            judged(robot_name, torque, model, seeds, logs)


if __name__ == "__main__":
    main([int(seed) for seed in sys.argv[1:]] or [801])
