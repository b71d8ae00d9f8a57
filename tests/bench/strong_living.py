#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Living cells on equations of their own: soft gears, ripple, work pieces, coarse encoders, late stamps, lost rows.

Usage: strong_living.py [CELL...]     called by strong_living.sh; SEED in the environment draws other robots
"""
import collections
import math
import os
import random
import sys

import numpy as np

import healthy_but_different as simulated
import own_cells

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "strong-living")
SEED = int(os.environ.get("SEED", "1"))
DAYS, HEALTHY, SUBSTEP_S, G = 6, 12, 0.00025, 9.81
STIFFNESS = 1.5e4  # N m/rad
RIPPLE = 0.015     # of the torque
TRIP = np.array([[15.0], [15.0], [3.0]])  # speeds at which a log ends
REACH = [2.0, 2.0, 0.14]


class Cell:
    def __init__(self, period_s=0.002, control_s=0.002, length_s=10.0, piece=0.0, tool=0.0, codes=None, late_rows=0,
                 jitter_s=0.0, lost=0.0, difference=False, noise=(1e-5, 1e-3), gains=0.0, warm=0.0):
        self.period_s, self.control_s, self.length_s, self.piece, self.tool = period_s, control_s, length_s, piece, tool
        self.codes, self.late_rows, self.jitter_s, self.lost, self.difference = codes, late_rows, jitter_s, lost, difference
        self.noise, self.gains, self.warm = noise, gains, warm  # of position and velocity; of a day; warming up
        self.bandwidth = 18.0 if control_s < 0.005 else 8.0  # rad/s


CELLS = {
    "loaded": Cell(control_s=0.001, piece=0.5, codes=17, noise=(2e-6, 2e-3), warm=0.25),
    "coarse": Cell(codes=15, difference=True, jitter_s=5e-4, lost=0.01, noise=(0.0, 0.0), gains=0.02),
    "slow": Cell(period_s=0.01, control_s=0.01, length_s=20.0, tool=0.01, late_rows=1, noise=(3e-5, 3e-3)),
}
KINDS = ("free_swinging", "locked", "torque_loss", "sensor_bias", "stuck_encoder", "sensor_drift", "friction_increase",
         "collision", "payload_change")
UNKNOWN = ("slip", "play", "worn spot")


class Batch:
    """What differs between the runs of a cell: arrays of joints x runs, or one value a run."""

    def __init__(self, cell, robot, runs, rng):
        n = self.n = len(runs)
        zeros, ones = (lambda: np.zeros((3, n))), (lambda: np.ones((3, n)))
        self.onset = np.array([run["onset"] for run in runs])
        self.kept, self.friction, self.lock, self.push = ones(), ones(), zeros(), zeros()
        self.bias, self.drift, self.stuck, self.slip, self.play, self.spot = (zeros() for _ in range(6))
        self.mass, self.push_s = np.zeros(n), np.ones(n)
        for i, run in enumerate(runs):
            self.set_fault(i, run["kind"], run["joint"] - 1, robot, rng)
        self.day = rng.uniform(0.75, 1.35, (1, n)) * np.ones((3, 1))
        self.cold = rng.integers(0, 2, n) * cell.warm
        self.gain = 1 + rng.uniform(-cell.gains, cell.gains, (3, n))
        self.noise = rng.uniform(0.7, 1.6, n)
        self.tool = rng.uniform(-cell.tool, cell.tool, n) * robot.m[2]
        self.piece = cell.piece * robot.m[2] * switching(rng, n, cell.length_s)

    def set_fault(self, i, kind, j, robot, rng):
        slide = j == 2
        values = {"torque_loss": (self.kept, 1 - rng.uniform(0.4, 0.7)), "free_swinging": (self.kept, 0.0),
                  "locked": (self.lock, 1.0), "sensor_bias": (self.bias, 0.004 if slide else 0.02),
                  "stuck_encoder": (self.stuck, 1.0), "sensor_drift": (self.drift, 0.01 if slide else 0.04),
                  "friction_increase": (self.friction, 3.0), "collision": (self.push, 0.25 * robot.rating[j]),
                  "slip": (self.slip, 0.05), "play": (self.play, 0.02), "worn spot": (self.spot, 2 * robot.coulomb[j])}
        if kind == "payload_change":
            self.mass[i] = 0.8 * robot.m[2]
        elif kind:
            values[kind][0][j, i] = values[kind][1]
        self.push_s[i] = rng.uniform(0.06, 0.12)


def switching(rng, n, length_s):
    """0 or 1 for each millisecond and run: a work piece that comes and goes."""
    out = np.zeros((int(length_s * 1000) + 20, n))
    for i in range(n):
        at, level = 0, int(rng.integers(0, 2))
        while at < len(out):
            end = at + int(rng.uniform(900, 2500))
            out[at:end, i] = level
            at, level = end, 1 - level
    return out


def motion(rng, n, times):
    """Smooth moves between random places, with rests: position, velocity, acceleration (times x 3 x n)."""
    out = np.zeros((3, len(times), 3, n))
    for i in range(n):
        for j in range(3):
            at, place = 0.0, rng.uniform(-1, 1) * REACH[j]
            while at <= times[-1]:
                move, rest, goal = rng.uniform(0.8, 1.5), rng.uniform(0.02, 0.35), rng.uniform(-1, 1) * REACH[j]
                part = (times >= at) & (times < at + move + rest)
                x, way = np.clip((times[part] - at) / move, 0, 1), goal - place
                out[0, part, j, i] = place + way * (10 * x**3 - 15 * x**4 + 6 * x**5)
                out[1, part, j, i] = way / move * (30 * x**2 - 60 * x**3 + 30 * x**4)
                out[2, part, j, i] = way / move**2 * (60 * x - 180 * x**2 + 120 * x**3)
                at, place = at + move + rest, goal
    return out


class Arm:
    """Two links on soft gears, encoders on the motors, and a stiff slide along gravity."""

    def __init__(self, robot, rng):
        m, l = robot.m, robot.l
        self.l, self.m3 = l, m[2]
        self.a = (m[0] / 3 + m[1] + m[2]) * l[0]**2
        self.b, self.c = (m[1] / 3 + m[2]) * l[1]**2, (m[1] / 2 + m[2]) * l[0] * l[1]
        self.motor = np.array([[0.25 * self.a], [0.25 * self.b]])
        self.stiffness = np.array([[STIFFNESS], [STIFFNESS * min(1.0, 2.5 * self.b / self.a)]])
        self.damping = 0.1 * np.sqrt(self.stiffness * self.motor)
        column = lambda values: np.array(values)[:, None]
        self.viscous, self.coulomb, self.width = column(robot.viscous), column(robot.coulomb), column([0.02, 0.02, 0.005])
        self.rating, self.waves, self.phase = column(robot.rating), column([20, 16, 80]), rng.uniform(0, 6, (3, 1))

    def inertia(self, extra, q2):
        a, b, c = self.a + self.l[0]**2 * extra, self.b + self.l[1]**2 * extra, self.c + self.l[0] * self.l[1] * extra
        return a + b + 2 * c * np.cos(q2), b + c * np.cos(q2), b, c * np.sin(q2)

    def commanded(self, r, q, dq, bandwidth):
        """Computed torque of a robot that is 3 % off, and PD."""
        place, speed, goal = r
        want = goal + bandwidth**2 * (place - q) + 1.4 * bandwidth * (speed - dq)
        m11, m12, m22, h = self.inertia(0.03 * self.m3, q[1])
        own = 0.9 * (self.viscous * speed + self.coulomb * np.tanh(speed / self.width))
        tau = np.array([(m11 + self.motor[0]) * want[0] + m12 * want[1] - h * (2 * dq[0] * dq[1] + dq[1]**2),
                        m12 * want[0] + (m22 + self.motor[1]) * want[1] + h * dq[0]**2,
                        1.03 * self.m3 * (want[2] + G)]) + own
        return np.clip(tau, -self.rating, self.rating)

    def step(self, s, drive, fr, extra, lock, play):
        """s: motors (3), links (2) and their velocities; semi-implicit."""
        theta, dtheta, q, dq = s
        bend = theta[:2] - q
        if play is not None:
            bend = np.sign(bend) * np.maximum(np.abs(bend) - 0.5 * play, 0)
            in_mesh = (bend != 0) | (play == 0)
        else:
            in_mesh = 1.0
        spring = self.stiffness * bend + self.damping * (dtheta[:2] - dq) * in_mesh
        friction = fr * (self.viscous * dtheta + self.coulomb * np.tanh(dtheta / self.width))
        m11, m12, m22, h = self.inertia(extra, q[1])
        t1, t2 = spring[0] + h * (2 * dq[0] * dq[1] + dq[1]**2), spring[1] - h * dq[0]**2
        det = m11 * m22 - m12 * m12
        dq = dq + SUBSTEP_S * np.array([(m22 * t1 - m12 * t2) / det, (m11 * t2 - m12 * t1) / det])
        force = drive - friction
        rate = np.concatenate([(force[:2] - spring) / self.motor, (force[2:] / (self.m3 + extra)) - G])
        dtheta = (dtheta + SUBSTEP_S * rate) * (1 - lock)
        return theta + SUBSTEP_S * dtheta, dtheta, q + SUBSTEP_S * dq, dq


def measured(cell, batch, theta, dtheta, since, memory, rng):
    on = since >= 0
    q = theta + cell.noise[0] * batch.noise * np.array([[1], [1], [.2]]) * rng.normal(size=theta.shape)
    dq = dtheta + cell.noise[1] * batch.noise * np.array([[1], [1], [.2]]) * rng.normal(size=theta.shape)
    late = np.maximum(since, 0)
    q = q + on * batch.bias + late * batch.drift + on * batch.slip * (1 + np.floor(late / 0.4))
    dq = dq + on * batch.drift
    if cell.codes:
        code = np.array([[2 * math.pi / 2**cell.codes], [2 * math.pi / 2**cell.codes], [2**(17 - cell.codes) * 5e-6]])
        q = np.round(q / code) * code
    held = (batch.stuck > 0) & on
    fresh = held & ~memory["held"]
    memory["q"], memory["dq"] = np.where(fresh, q, memory["q"]), np.where(fresh, dq, memory["dq"])
    memory["held"] = held
    return np.where(held, memory["q"], q), np.where(held, memory["dq"], dq)


def simulate(cell, robot, runs, seed):
    """A table of rows for each run: t, q, dq, tau."""
    rng = np.random.default_rng(seed)
    batch, arm = Batch(cell, robot, runs, rng), Arm(robot, np.random.default_rng(SEED))
    ticks = int(round(cell.length_s / cell.control_s))
    r = motion(rng, batch.n, np.arange(ticks) * cell.control_s)
    s = (r[0, 0], r[1, 0], r[0, 0, :2], r[1, 0, :2])
    memory = {"q": np.zeros((3, batch.n)), "dq": np.zeros((3, batch.n)), "held": np.zeros((3, batch.n), bool)}
    before, alive, tables = r[0, 0], np.ones(batch.n, bool), [[] for _ in runs]
    every, substeps = round(cell.period_s / cell.control_s), round(cell.control_s / SUBSTEP_S)
    for k in range(ticks):
        t = k * cell.control_s
        q, dq = measured(cell, batch, s[0], s[1], t - batch.onset, memory, rng)
        if cell.difference:
            dq, before = (q - before) / cell.control_s, q
        tau = arm.commanded(r[:, k], q, dq, cell.bandwidth)
        alive &= (np.abs(s[1]) < TRIP).all(0)
        if k % every == 0:
            for i in np.flatnonzero(alive):
                tables[i].append([t, *q[:, i], *dq[:, i], *tau[:, i]])
        for i in range(substeps):
            s = tuple(np.where(alive, v, 0) for v in one_substep(arm, batch, s, tau, t + i * SUBSTEP_S))
    return [np.array(table) for table in tables]


def one_substep(arm, batch, s, tau, t):
    since = t - batch.onset
    on = since >= 0
    drive = tau * batch.gain * (1 + RIPPLE * np.sin(arm.waves * s[0] + arm.phase)) * np.where(on, batch.kept, 1)
    drive = drive + batch.push * (on & (since < batch.push_s))
    reach = np.array(REACH)[:, None]
    drive = drive - on * batch.spot * np.tanh(s[1] / arm.width) * (np.abs(s[0]) < 0.25 * reach)
    friction = batch.day * (1 + batch.cold * math.exp(-t / 8.0)) * np.where(on, batch.friction, 1)
    extra = batch.tool + batch.piece[int(t * 1000)] + on * batch.mass
    return arm.step(s, drive, friction, extra, batch.lock * on, batch.play[:2] * on if batch.play.any() else None)


def write(cell, table, path, seed):
    rng = np.random.default_rng(seed)
    if cell.late_rows:
        table[cell.late_rows:, 7:] = table[:-cell.late_rows, 7:].copy()
    if cell.jitter_s:
        table[:, 0] = np.round(table[:, 0] + rng.normal(size=len(table)) * cell.jitter_s, 3)
        table = table[np.concatenate([[True], np.diff(np.maximum.accumulate(table[:, 0])) > 0])]
        table = table[rng.random(len(table)) >= cell.lost]
    np.savetxt(path, table, delimiter=",", fmt="%.9g", header="t,q1,q2,q3,dq1,dq2,dq3,tau1,tau2,tau3", comments="")


def runs_of(cell, rng):
    healthy = [{"name": f"healthy_{i}", "kind": "", "joint": 0, "onset": math.inf} for i in range(DAYS + HEALTHY)]
    faults = [(kind, j) for kind in KINDS for j in (1, 2, 3)] + [("slip", 2), ("play", 2), ("worn spot", 1)]
    return healthy + [{"name": f"{kind.replace(' ', '_')}_{j}", "kind": kind, "joint": j,
                       "onset": round(rng.uniform(0.3, 0.6) * cell.length_s, 4)} for kind, j in faults]


def score(runs, reports, count):
    """Counts of one cell and what went wrong."""
    notes = []
    for run, report in zip(runs, reports):
        kind, faults = run["kind"], report["faults"]
        early = [f for f in faults if f["alarm_s"] < run["onset"] - 1e-9]
        after = [f for f in faults if f["alarm_s"] >= run["onset"] - 1e-9]
        if not kind:
            count["healthy"] += 1
            count["alarms"] += bool(faults)
            good = not faults
        else:
            group = "unknown" if kind in UNKNOWN else "known"
            want = "unknown" if kind in UNKNOWN else kind
            joint = 3 if kind == "payload_change" else run["joint"]
            same = lambda f: f["kind"] == want and (want == "unknown" or f["joint"] == joint)
            good = bool(after) and same(after[0])
            named = good or bool(after) and any(same(f) for f in after[0].get("could_also_be", []))
            for key, value in (("runs", 1), ("found", bool(after)), ("right", good), ("named", named)):
                count[group, key] += value
            count["early"] += bool(early)
            good = good and not early
        if not good:
            notes.append(f"{run['name']}: onset {run['onset']:.2f}, reported {simulated.said(faults)}")
    return notes


def judge(name, count):
    cell, rng = CELLS[name], random.Random(f"strong {name} {SEED}")
    robot, runs, folder = own_cells.Robot(rng), runs_of(cell, rng), os.path.join(OUT, f"{name}_{SEED}")
    os.makedirs(folder, exist_ok=True)
    paths = [os.path.join(folder, run["name"] + ".csv") for run in runs]
    for i, (table, path) in enumerate(zip(simulate(cell, robot, runs, 1000 * SEED + len(name)), paths)):
        write(cell, table, path, i)
    model, _ = simulated.learn_from(paths[:DAYS], folder, robot.l[0])
    return score(runs[DAYS:], simulated.diagnose_all(paths[DAYS:], model), count)


def line(name, count):
    known, unknown = ([count[group, key] for key in ("found", "right", "named", "runs")] for group in ("known", "unknown"))
    return (f"| {name} | {count['alarms']} of {count['healthy']} | {known[0]} of {known[3]} | {known[1]} | {known[2]} | "
            f"{count['early']} | {unknown[0]} of {unknown[3]} | {unknown[1]} |")


def main(wanted):
    print("| cell | healthy with alarm | found | right | or named | early | unknown found | called so |")
    print("|---|---|---|---|---|---|---|---|")
    total, notes = collections.Counter(), []
    for name in CELLS:
        if not wanted or name in wanted:
            count = collections.Counter()
            notes += [f"{name}/{note}" for note in judge(name, count)]
            print(line(name, count), flush=True)
            total += count
    print(line("all", total))
    print("\n" + "\n".join(notes))


if __name__ == "__main__":
    main(sys.argv[1:])
