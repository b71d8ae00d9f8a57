#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Unknown, creeping and known faults on a SCARA of its own equations: simulates, learns, diagnoses, prints a table.

Usage: unknown_faults.py     called by unknown_faults.sh
"""
import collections
import math
import os
import sys

import numpy as np

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "unknown-faults")
RATE_HZ = 500
SUBSTEPS = 3
A, B, C, M3, G = 1.04125, 0.345, 0.4725, 2.5, 9.81
L1, L2 = 0.35, 0.3
VISCOUS, COULOMB, WIDTH = [1.2, 0.6, 15.0], [2.0, 1.0, 6.0], 0.01
REACH = [1.2, 1.3, 0.09]
KP, KD, LIMIT = [1200, 500, 15000], [50, 18, 400], [80, 40, 300]
DAY_FRICTION = 0.1
REPEATS = 2
ROBOT = 'axes = "RRP"\n\n[known]\nl1 = 0.35\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "held"\n'

# kind: sizes by joint
UNKNOWN = {
    "clipping drive": [4.0, 2.5, 30.0],
    "vibration": [6.0, 3.0, 25.0],
    "worn spot": [6.0, 3.0, 20.0],
    "drop-outs": [0.3, 0.3, 0.3],
    "noise": [8.0, 4.0, 30.0],
}
CREEPING = {"creeping friction": [0.04, 0.04, 0.1]}  # a second
KNOWN = {
    "free_swinging": [0.0, 0.0],
    "torque_loss": [0.5, 0.4, 0.3],
    "locked": [0.0, 0.0, 0.0],
    "sensor_bias": [0.02, 0.02, 0.003],
    "sensor_drift": [0.03, 0.03],
    "stuck_encoder": [0.0, 0.0],
    "friction_increase": [3.0, 3.0, 3.0],
    "payload_change": [1.5, -1.0],
    "collision": [25.0, 15.0, 80.0],
}
PUSHES_S = {"push of 0.2 s": 0.2, "push of 0.5 s": 0.5, "push of 1 s": 1.0}  # half a sine
PUSHED = [15.0, 8.0, 60.0]


class Change:
    """What a fault makes of the robot at one moment."""

    def __init__(self):
        self.friction, self.mass, self.locked, self.spot = [1.0] * 3, 0.0, -1, None


def acceleration(q, dq, drive, day, change):
    s, c = math.sin(q[1]), math.cos(q[1])
    dm = change.mass
    a, b, cc, m3 = A + L1 * L1 * dm, B + L2 * L2 * dm, C + L1 * L2 * dm, M3 + dm
    m11, m12, m22 = a + b + 2 * cc * c, b + cc * c, b
    torque = []
    for j in range(3):
        sign = math.tanh(dq[j] / WIDTH)
        friction = day[j] * change.friction[j] * (VISCOUS[j] * dq[j] + COULOMB[j] * sign)
        if change.spot and change.spot[0] == j and abs(q[j]) < 0.25 * REACH[j]:
            friction += change.spot[1] * sign
        torque.append(drive[j] - friction)
    t1 = torque[0] + cc * s * (2 * dq[0] * dq[1] + dq[1] ** 2)
    t2 = torque[1] - cc * s * dq[0] ** 2
    lift = 0.0 if change.locked == 2 else torque[2] / m3 - G
    if change.locked == 0:
        return [0.0, t2 / m22, lift]
    if change.locked == 1:
        return [t1 / m11, 0.0, lift]
    det = m11 * m22 - m12 * m12
    return [(m22 * t1 - m12 * t2) / det, (m11 * t2 - m12 * t1) / det, lift]


def step(q, dq, drive, day, change):
    """Midpoint rule over a sample."""
    h = 1.0 / RATE_HZ / SUBSTEPS
    for _ in range(SUBSTEPS):
        k = acceleration(q, dq, drive, day, change)
        half = [v + 0.5 * h * x for v, x in zip(dq, k)]
        k = acceleration([x + 0.5 * h * v for x, v in zip(q, dq)], half, drive, day, change)
        q = [x + h * v for x, v in zip(q, half)]
        dq = [v + h * x for v, x in zip(dq, k)]
    return q, dq


def reference(rng, rows):
    """Positions, velocities and accelerations: sums of four sines within the reach."""
    t = np.arange(rows) / RATE_HZ
    out = np.zeros((3, rows, 3))
    for j in range(3):
        for _ in range(4):
            w, phase, size = 2 * np.pi * rng.uniform(0.1, 0.9), rng.uniform(0, 6.28), rng.uniform(0.3, 1)
            out[0, :, j] += size * np.sin(w * t + phase)
            out[1, :, j] += size * w * np.cos(w * t + phase)
            out[2, :, j] -= size * w * w * np.sin(w * t + phase)
        out[:, :, j] *= REACH[j] / np.abs(out[0, :, j]).max()
    return out


def commanded(r, dr, ddr, q, dq):
    """Computed torque of the nominal robot with PD."""
    c, s = math.cos(q[1]), math.sin(q[1])
    m11, m12 = A + B + 2 * C * c, B + C * c
    ahead = [m11 * ddr[0] + m12 * ddr[1] - C * s * (2 * dq[0] * dq[1] + dq[1] ** 2),
             m12 * ddr[0] + B * ddr[1] + C * s * dq[0] ** 2, M3 * (ddr[2] + G)]
    tau = [ahead[j] + VISCOUS[j] * dr[j] + KP[j] * (r[j] - q[j]) + KD[j] * (dr[j] - dq[j]) for j in range(3)]
    return [max(-m, min(m, x)) for x, m in zip(tau, LIMIT)]


def disturbed(kind, j, size, since, seed, noise, drive):
    """The torque that arrives and what else becomes of the robot."""
    drive, change = list(drive), Change()
    if kind == "free_swinging":
        drive[j] = 0.0
    elif kind == "torque_loss":
        drive[j] *= 1 - size
    elif kind == "locked":
        change.locked = j
    elif kind == "friction_increase":
        change.friction[j] = size
    elif kind == "creeping friction":
        change.friction[j] = 1 + size * since
    elif kind == "payload_change":
        change.mass = size
    elif kind == "collision" and since < 0.08:
        drive[j] += size
    elif kind in PUSHES_S:
        drive[j] += size * max(0.0, math.sin(math.pi * since / PUSHES_S[kind])) * (since < PUSHES_S[kind])
    elif kind == "clipping drive":
        drive[j] = max(-size, min(size, drive[j]))
    elif kind == "vibration":
        drive[j] += size * math.sin(2 * np.pi * (11 + 4 * (seed % 5)) * since)
    elif kind == "worn spot":
        change.spot = (j, size)
    elif kind == "drop-outs" and (4 * since) % 1 < 0.4:
        drive[j] *= size
    elif kind == "noise":
        drive[j] += size * noise
    return drive, change


def simulate(path, seed, duration_s, kind=None, j=0, size=0.0, onset_s=0.0):
    rng = np.random.default_rng(seed)
    rows = int(duration_s * RATE_HZ)
    day = 1 + DAY_FRICTION * rng.uniform(-1, 1, 3)
    r, dr, ddr = reference(rng, rows)
    q_noise = rng.normal(size=(rows, 3)) * [2e-5, 2e-5, 5e-6]
    dq_noise = rng.normal(size=(rows, 3)) * [2e-3, 2e-3, 4e-4]
    shaking = np.repeat(rng.normal(size=rows // 5 + 1), 5)
    q, dq, out, stuck = list(r[0]), list(dr[0]), [], None
    for k in range(rows):
        since = k / RATE_HZ - onset_s
        faulty = kind is not None and since >= 0
        mq, mdq = list(q + q_noise[k]), list(dq + dq_noise[k])
        if faulty and kind == "sensor_bias":
            mq[j] += size
        if faulty and kind == "sensor_drift":
            mq[j], mdq[j] = mq[j] + size * since, mdq[j] + size
        if faulty and kind == "stuck_encoder":
            stuck = stuck or (mq[j], mdq[j])
            mq[j], mdq[j] = stuck
        drive = commanded(r[k], dr[k], ddr[k], mq, mdq)
        out.append([k / RATE_HZ, *mq, *mdq, *drive])
        change = Change()
        if faulty:
            drive, change = disturbed(kind, j, size, since, seed, shaking[k], drive)
        if change.locked >= 0:
            dq[change.locked] = 0.0
        q, dq = step(q, dq, drive, day, change)
        if not all(map(math.isfinite, q)) or max(map(abs, dq)) > 60:
            break
    np.savetxt(path, np.array(out), delimiter=",", fmt="%.9g", header="t,q1,q2,q3,dq1,dq2,dq3,tau1,tau2,tau3",
               comments="")


def verdict(kind, wanted, joint, onset_s, faults):
    """early, missed, right or the name given, by the first finding."""
    if not faults:
        return "missed"
    first = faults[0]
    if first["alarm_s"] < onset_s - 1.0 / RATE_HZ:
        return "early"
    right_joint = wanted == "unknown" or first["joint"] == (3 if wanted == "payload_change" else joint + 1)
    return "right" if first["kind"] == wanted and right_joint else first["kind"]


def simulated_runs():
    """(name, kind to be reported, joint from 0, onset, path) of each log."""
    seed, runs = 100, []
    groups = [("unknown", UNKNOWN), ("friction_increase", CREEPING), (None, KNOWN),
              ("collision", {push: PUSHED for push in PUSHES_S}), ("none", {"healthy": [0.0] * 4})]
    for wanted, kinds in groups:
        for kind, sizes in kinds.items():
            for j, size in [(j, s) for _ in range(REPEATS) for j, s in enumerate(sizes)]:
                seed += 1
                path, onset_s = f"{OUT}/run_{seed}.csv", 5 + 0.37 * (seed % 7)
                simulate(path, seed, 30.0 if kind in CREEPING else 12.0, None if wanted == "none" else kind, j % 3, size,
                         onset_s)
                runs.append((kind, wanted or kind, j % 3, onset_s, path))
    return runs


def main():
    os.makedirs(OUT, exist_ok=True)
    for i in range(3):
        simulate(f"{OUT}/healthy_{i}.csv", i + 1, 15.0)
    with open(f"{OUT}/robot.toml", "w", encoding="utf-8") as file:
        file.write(ROBOT)
    model, _ = simulated.learned([f"{OUT}/healthy_{i}.csv" for i in range(3)], OUT)
    print("| fault | logs | right | missed | early | else |\n|---|---|---|---|---|---|")
    runs = simulated_runs()
    reports = simulated.diagnose_all([run[-1] for run in runs], model)
    tallies = collections.defaultdict(collections.Counter)
    for (name, wanted, joint, onset_s, path), report in zip(runs, reports):
        said, healthy = report["faults"], wanted == "none"
        what = ("early" if said else "right") if healthy else verdict(name, wanted, joint, onset_s, said)
        tallies[name][what] += 1
        if what != "right":
            print(f"{os.path.basename(path)}: {name} {joint + 1}, reported {simulated.said(said)}, onset {onset_s:.2f}",
                  file=sys.stderr)
    for name, tally in tallies.items():
        others = ", ".join(f"{n} {what}" for what, n in tally.items() if what not in ("right", "missed", "early"))
        print(f"| {name} | {sum(tally.values())} | {tally['right']} | {tally['missed']} | {tally['early']} | {others} |")


if __name__ == "__main__":
    main()
