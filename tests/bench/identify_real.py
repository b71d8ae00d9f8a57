#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Identification on logs of real robots: faultline identify against a least squares on inverse dynamics.

    apt-get install python3-numpy python3-scipy
    bash tests/bench/identify_real.sh [ROBOT...]

The peer is what is usually done with numpy: positions through a zero-phase Butterworth filter, central
differences, a regressor of ten inertial numbers a link, rotor inertia, viscous and Coulomb friction and
offset, base parameters by pivoted QR, torque and regressor through one low-pass and decimated (parallel
filtering), least squares weighted by joint. Its filters, the source of velocity, the width of Coulomb
friction, the torque's delay of each joint and whether parameters known worse than 30 % are left out are
chosen on the logs it is fitted to, by cross-validation under the evaluator's own filters: an advantage that
faultline does not have. Both results are numbers of the same model, and one evaluator judges both on
held-out logs: model torque of smoothed motion against logged torque, the same low-pass over both. Processor
time is user and system, reading included.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tomllib

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np
from scipy.linalg import cho_factor, cho_solve, qr
from scipy.signal import butter, decimate, filtfilt

HERE = pathlib.Path(__file__).resolve().parent
DELAYS = np.arange(-0.004, 0.0245, 0.0005)  # s that the torque acts later than it is logged

# Low-passes of the evaluator for motion and for torque in Hz, and speed above which a joint moves.
JUDGE = {
    "double_pendulum": (30.0, 10.0, 0.15),
    "acrobot": (30.0, 10.0, 0.15),
    "pendubot": (30.0, 10.0, 0.15),
    "emps": (60.0, 20.0, 0.01),
    "staubli_tx40": (60.0, 20.0, 0.15),
}


# ---------------------------------------------------------------- robot, regressor, model

class Robot:
    """The facts of a robot file that inverse dynamics needs."""

    def __init__(self, path):
        file = tomllib.loads(pathlib.Path(path).read_text())
        joints = file.get("joint", [])
        if not joints:
            known = file.get("known", {})
            for i, kind in enumerate(file["axes"]):
                offset = [known.get(f"l{i}", 0.0) if i else 0.0, 0.0, 0.0]
                kind = "revolute" if kind == "R" else "prismatic"
                joints.append({"kind": kind, "axis": [0, 0, 1], "offset": offset})
        self.n = len(joints)
        self.revolute = [j["kind"] == "revolute" for j in joints]
        self.axis = [np.array(j["axis"], float) for j in joints]
        self.offset = [np.array(j["offset"], float) for j in joints]
        self.gravity = np.array(file["gravity"], float)
        self.columns = file["log"]["columns"]


def skew(v):
    out = np.zeros(v.shape[:-1] + (3, 3))
    out[..., 0, 1], out[..., 0, 2], out[..., 1, 2] = -v[..., 2], v[..., 1], -v[..., 0]
    out[..., 1, 0], out[..., 2, 0], out[..., 2, 1] = v[..., 2], -v[..., 1], v[..., 0]
    return out


def times_inertia(w):
    """I w = times_inertia(w) (xx yy zz xy xz yz)."""
    out = np.zeros(w.shape[:-1] + (3, 6))
    x, y, z = w[..., 0], w[..., 1], w[..., 2]
    out[..., 0, 0], out[..., 0, 3], out[..., 0, 4] = x, y, z
    out[..., 1, 1], out[..., 1, 3], out[..., 1, 5] = y, x, z
    out[..., 2, 2], out[..., 2, 4], out[..., 2, 5] = z, x, y
    return out


def rotation(axis, angle):
    k = skew(axis / np.linalg.norm(axis))
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def turned(matrix, v):
    """Transposed rotation of each sample times a vector."""
    return np.einsum("kji,kj->ki", matrix, v)


def regressor(robot, q, dq, ddq):
    """Joint torque by the links' numbers (mass, first moment, inertia about the joint)."""
    rows, n = q.shape
    out = np.zeros((rows, n, 10 * n))
    w, dw = np.zeros((rows, 3)), np.zeros((rows, 3))
    a = np.tile(-robot.gravity, (rows, 1))
    turning, sliding = [], []  # of the link's frame by a unit rate of each joint so far
    for i in range(n):
        axis = robot.axis[i]
        if robot.revolute[i]:
            r, p = rotation(axis, q[:, i]), np.tile(robot.offset[i], (rows, 1))
        else:
            r, p = np.tile(np.eye(3), (rows, 1, 1)), robot.offset[i] + axis * q[:, i:i + 1]
        a = turned(r, a + np.cross(dw, p) + np.cross(w, np.cross(w, p)))
        sliding = [turned(r, s + np.cross(t, p)) for s, t in zip(sliding, turning)]
        turning = [turned(r, t) for t in turning]
        w, dw = turned(r, w), turned(r, dw)
        rate = np.tile(axis, (rows, 1)) * dq[:, i:i + 1]
        if robot.revolute[i]:
            dw = dw + axis * ddq[:, i:i + 1] + np.cross(w, rate)
            w = w + rate
        else:
            a = a + axis * ddq[:, i:i + 1] + 2 * np.cross(w, rate)
        still, moves = np.zeros((rows, 3)), np.tile(axis, (rows, 1))
        turning.append(moves if robot.revolute[i] else still)
        sliding.append(still if robot.revolute[i] else moves)
        force, moment = np.zeros((rows, 3, 10)), np.zeros((rows, 3, 10))
        force[:, :, 0] = a
        force[:, :, 1:4] = skew(dw) + skew(w) @ skew(w)
        moment[:, :, 1:4] = -skew(a)
        moment[:, :, 4:] = times_inertia(dw) + skew(w) @ times_inertia(w)
        for j in range(i + 1):
            out[:, j, 10 * i:10 * i + 10] = (np.einsum("ki,kip->kp", turning[j], moment)
                                             + np.einsum("ki,kip->kp", sliding[j], force))
    return out


def full_regressor(robot, motion, width, coupled=None):
    """With rotor inertia, viscous and Coulomb friction and offset of each joint. `coupled`: two joints (from
    0) whose sum turns one motor, which adds its inertia, viscous and Coulomb friction."""
    q, dq, ddq = motion
    rows, n = q.shape
    width = np.broadcast_to(width, n)
    own = np.zeros((rows, n, 4 * n))
    for j in range(n):
        own[:, j, j], own[:, j, n + j] = ddq[:, j], dq[:, j]
        own[:, j, 2 * n + j], own[:, j, 3 * n + j] = np.tanh(dq[:, j] / width[j]), 1.0
    parts = [regressor(robot, q, dq, ddq), own]
    if coupled:
        shared = np.zeros((rows, n, 3))
        for here, there in (coupled, coupled[::-1]):
            shared[:, here, 0], shared[:, here, 1] = ddq[:, there], dq[:, there]
            shared[:, here, 2] = np.tanh((dq[:, here] + dq[:, there]) / width[here])
        parts.append(shared)
    return np.concatenate(parts, axis=2)


# ---------------------------------------------------------------- logs

def read_log(robot, path):
    """Time, q, dq (or None) and torque in SI at the log's median rate."""
    names = [name.strip() for name in open(path).readline().split(",")]
    table = np.loadtxt(path, delimiter=",", skiprows=1)

    def channel(key):
        spec = robot.columns.get(key, key)
        spec = {"name": spec} if isinstance(spec, str) else spec
        return spec.get("scale", 1.0) * table[:, names.index(spec["name"])] if spec["name"] in names else None

    def group(kind):
        columns = [channel(f"{kind}{j + 1}") for j in range(robot.n)]
        return None if columns[0] is None else np.stack(columns, 1)

    t, q, dq, tau = channel("t"), group("q"), group("dq"), group("tau")
    keep = np.concatenate([[True], np.diff(t) > 0])
    even = np.arange(t[0], t[-1], np.median(np.diff(t)))
    evenly = lambda x: None if x is None else np.stack([np.interp(even, t[keep], c[keep]) for c in x.T], 1)
    return even, evenly(q), evenly(dq), evenly(tau)


def low_pass(x, hz, rate, order=4):
    if hz >= 0.45 * rate:
        return x
    b, a = butter(order, 2 * hz / rate)
    return filtfilt(b, a, x, axis=0, padlen=min(len(x) - 1, int(3 * rate / hz)))


def motion_of(log, hz, from_logged_velocity=False):
    t, q, dq, _ = log
    step = t[1] - t[0]
    q = low_pass(q, hz, 1 / step)
    dq = low_pass(dq, hz, 1 / step) if from_logged_velocity else np.gradient(q, step, axis=0)
    return q, dq, np.gradient(dq, step, axis=0)


def kept_samples(log, hz):
    """Of a signal below hz: few enough to be nearly independent, without the ends that filters spoil."""
    t = log[0]
    step = t[1] - t[0]
    edge, every = int(1.0 / hz / step) + 1, max(1, int(1.0 / (4 * hz) / step))
    return np.arange(edge, len(t) - edge, every)


# ---------------------------------------------------------------- the evaluator of both

def judged_part(robot, log, motion_hz, torque_hz, model):
    motion = motion_of(log, motion_hz)
    t, rate = log[0], 1 / (log[0][1] - log[0][0])
    columns = full_regressor(robot, motion, model["width"], model.get("coupled"))
    torque = columns @ np.array(model["numbers"])
    add_extra_terms(robot, motion, model, columns, torque)
    for j, (bend, width, skew) in enumerate(model.get("bends", [])):
        torque[:, j] += bend * np.tanh(motion[1][:, j] / width) + skew * np.abs(motion[1][:, j])
    torque /= np.array(model.get("gain", [1.0] * robot.n))
    at = kept_samples(log, torque_hz)
    return low_pass(torque, torque_hz, rate)[at], t, at, low_pass(log[3], torque_hz, rate), motion[1][at]


def add_extra_terms(robot, motion, model, columns, torque):
    """Load friction, ripples and drives that joints share of an identified robot."""
    q, dq, ddq = motion
    rigid = 11 * robot.n  # links and rotors
    carried = columns[:, :, :rigid] @ np.array(model["numbers"][:rigid])
    for drive in model.get("shared", []):
        along = np.array(drive["along"])
        carried += np.outer(drive["rotor_inertia"] * ddq @ along, along)
        speed = dq @ along
        drag = (drive["viscous"] * speed + drive["coulomb"] * np.tanh(speed / drive["width"])
                + drive["rotor_inertia"] * ddq @ along)
        torque += np.outer(drag, along)
    for j, load in enumerate(model.get("load", [])):
        torque[:, j] += load * np.abs(carried[:, j]) * np.tanh(dq[:, j] / model["width"][j])
    for ripple in model.get("ripples", []):
        angle = ripple["rate"] * q[:, ripple["joint"] - 1]
        torque[:, ripple["joint"] - 1] += ripple["cosine"] * np.cos(angle) + ripple["sine"] * np.sin(angle)


def judge(robot, logs, model, name):
    """R2 of each joint over all samples and while it moves, and the torque left over, rms."""
    motion_hz, torque_hz, speed = JUDGE[name]
    model_torque, logged, moving = [], [], []
    for log in logs:
        torque, t, at, tau, dq = judged_part(robot, log, motion_hz, torque_hz, model)
        model_torque.append(torque)
        logged.append(np.stack([np.interp(t[at] - d, t, c) for d, c in zip(model["delay"], tau.T)], 1))
        moving.append(np.abs(dq) > speed)
    y, e = np.concatenate(logged), np.concatenate(logged) - np.concatenate(model_torque)
    moving = np.concatenate(moving)
    r2 = lambda e, y: 1 - np.sum(e * e) / np.sum((y - y.mean()) ** 2)
    joints = range(robot.n)
    return {"all": [r2(e[:, j], y[:, j]) for j in joints],
            "moving": [r2(e[moving[:, j], j], y[moving[:, j], j]) for j in joints],
            "rms": [math.sqrt(np.mean(e[:, j] ** 2)) for j in joints]}


# ---------------------------------------------------------------- the peer

class Peer:
    def __init__(self, robot, name, coupled=None):
        self.robot, self.name, self.coupled = robot, name, coupled
        rng = np.random.default_rng(1)
        rows = 20 * (10 * robot.n + 5)
        motion = [rng.uniform(-3, 3, (rows, robot.n)) for _ in range(3)]
        w = full_regressor(robot, motion, 0.01, coupled)
        w = w.reshape(-1, w.shape[2])
        size = np.linalg.norm(w, axis=0)
        used = np.flatnonzero(size > 1e-9 * size.max())
        _, r, order = qr(w[:, used] / size[used], mode="economic", pivoting=True)
        diagonal = np.abs(np.diag(r))
        self.base = np.sort(used[order[:np.sum(diagonal > 1e-8 * diagonal[0])]])
        self.parameters = w.shape[1]

    def parts(self, logs, motion_hz, logged_velocity):
        """Regressor before the parallel filter; Coulomb friction is put in later, by its width."""
        return [motion_of(log, motion_hz, logged_velocity) for log in logs]

    def blocks(self, logs, motions, torque_hz, width):
        """Blocks of the training logs: normal equations of each joint, for each delay of its torque."""
        out = []
        for log, motion in zip(logs, motions):
            t, rate = log[0], 1 / (log[0][1] - log[0][0])
            w = full_regressor(self.robot, motion, width, self.coupled)[:, :, self.base]
            at = kept_samples(log, torque_hz)
            w = low_pass(w.reshape(len(t), -1), torque_hz, rate).reshape(w.shape)[at]
            tau = low_pass(log[3], torque_hz, rate)
            # joint, delay, sample
            delayed = np.stack([[np.interp(t[at] - d, t, c) for d in DELAYS] for c in tau.T])
            for rows in np.array_split(np.arange(len(at)), 5 if len(logs) == 1 else 1):
                out.append({"a": [w[rows, j].T @ w[rows, j] for j in range(self.robot.n)],
                            "b": [w[rows, j].T @ delayed[j][:, rows].T for j in range(self.robot.n)],
                            "y": [np.sum(delayed[j][:, rows] ** 2, axis=1) for j in range(self.robot.n)],
                            "rows": len(rows)})
        return out

    def solve(self, blocks, delay=None, essential=False):
        """Numbers of the base, the delay of each joint (index into DELAYS) and the joints' residuals."""
        n = self.robot.n
        a = [sum(b["a"][j] for b in blocks) for j in range(n)]
        b = [sum(b["b"][j] for b in blocks) for j in range(n)]
        y = [sum(b["y"][j] for b in blocks) for j in range(n)]
        rows = sum(b["rows"] for b in blocks)
        scan = delay is None
        delay = [int(np.argmin(np.abs(DELAYS)))] * n if scan else delay
        weight = np.array([1 / y[j][delay[j]] for j in range(n)])
        columns = np.arange(len(self.base))
        size = np.sqrt(np.diag(sum(a)))
        size[size == 0] = 1.0

        def once(columns):
            scale = size[columns]
            whole = sum(w * m for w, m in zip(weight, a))[np.ix_(columns, columns)] / np.outer(scale, scale)
            factor = cho_factor(whole + 1e-12 * np.trace(whole) / len(whole) * np.eye(len(whole)))
            right = lambda d: sum(weight[j] * b[j][columns, d[j]] for j in range(n)) / scale
            return factor, right, scale

        def residual(x, j, d):
            return max(y[j][d] - 2 * x @ b[j][:, d] + x @ a[j] @ x, 1e-12 * y[j][d])

        for _ in range(8 if essential else 5):
            factor, right, scale = once(columns)
            for j in range(n if scan else 0):
                cost = []
                for d in range(len(DELAYS)):
                    trial = delay[:j] + [d] + delay[j + 1:]
                    x = np.zeros(len(self.base))
                    x[columns] = cho_solve(factor, right(trial)) / scale
                    cost.append(sum(weight[k] * residual(x, k, trial[k]) for k in range(n)))
                delay[j] = int(np.argmin(cost))
            x = np.zeros(len(self.base))
            x[columns] = cho_solve(factor, right(delay)) / scale
            left = np.array([residual(x, j, delay[j]) / rows for j in range(n)])
            weight = 1 / left / rows
            if essential:
                factor, right, scale = once(columns)
                deviation = np.sqrt(np.diag(cho_solve(factor, np.eye(len(columns)))) / rows) / scale
                relative = deviation / np.maximum(np.abs(x[columns]), 1e-300)
                worst = np.sort(relative)[-max(1, len(relative) // 10)]
                columns = columns[relative < max(0.3, worst)]
        return x, delay, left

    def model(self, x, delay, width):
        numbers = np.zeros(self.parameters)
        numbers[self.base] = x
        return {"numbers": numbers.tolist(), "width": width, "delay": [float(DELAYS[d]) for d in delay],
                "coupled": self.coupled}

    def cross_validated(self, blocks, judged, width, essential):
        """Share of torque variance that is left in blocks not fitted to, mean over joints; judged by the
        evaluator's filters, so that candidates with other filters compare."""
        _, delay, _ = self.solve(blocks, essential=False)
        n = self.robot.n
        left, total = np.zeros(n), np.zeros(n)
        for k, part in enumerate(judged):
            x, _, _ = self.solve(blocks[:k] + blocks[k + 1:], delay, essential)
            for j in range(n):
                y = part["tau"][j][delay[j]]
                e = y - part["w"][:, j] @ x
                left[j] += e @ e
                total[j] += np.sum((y - y.mean()) ** 2)
        return float(np.mean(left / total))

    def judged_blocks(self, logs, width):
        motion_hz, torque_hz, _ = JUDGE[self.name]
        out = []
        for log in logs:
            t, rate = log[0], 1 / (log[0][1] - log[0][0])
            w = full_regressor(self.robot, motion_of(log, motion_hz), width, self.coupled)
            at = kept_samples(log, torque_hz)
            w = low_pass(w.reshape(len(t), -1), torque_hz, rate).reshape(w.shape)[at]
            tau = low_pass(log[3], torque_hz, rate)
            for rows in np.array_split(np.arange(len(at)), 5 if len(logs) == 1 else 1):
                out.append({"w": w[rows][:, :, self.base],
                            "tau": [[np.interp(t[at[rows]] - d, t, c) for d in DELAYS] for c in tau.T]})
        return out

    def fit(self, logs):
        """The choices one after the other, twice for the first; each by cross-validation."""
        velocity = [False] if logs[0][2] is None else [False, True]
        speeds = max(np.abs(motion_of(log, 20.0)[1]).max() for log in logs)
        _, torque_hz, _ = JUDGE[self.name]
        options = {"motion_hz": [5.0, 10.0, 20.0, 40.0, 80.0], "logged_velocity": velocity,
                   "torque_hz": [torque_hz / 4, torque_hz / 2, torque_hz, 2 * torque_hz],
                   "width": [0.002 * speeds, 0.01 * speeds, 0.03 * speeds], "essential": [False, True]}
        chosen = {"motion_hz": 20.0, "logged_velocity": velocity[-1], "torque_hz": torque_hz,
                  "width": options["width"][0], "essential": False}
        judged, kept, seen = {}, {}, {}

        def score(c):
            key = tuple(c.values())
            if key not in seen:
                fitted = key[:-1]
                if fitted not in kept:
                    motions = self.parts(logs, c["motion_hz"], c["logged_velocity"])
                    kept[fitted] = self.blocks(logs, motions, c["torque_hz"], c["width"])
                if c["width"] not in judged:
                    judged[c["width"]] = self.judged_blocks(logs, c["width"])
                seen[key] = self.cross_validated(kept[fitted], judged[c["width"]], c["width"], c["essential"])
            return seen[key]

        for option in ("motion_hz", "logged_velocity", "torque_hz", "width", "motion_hz", "essential"):
            chosen = min(({**chosen, option: value} for value in options[option]), key=score)
        blocks = kept[tuple(chosen.values())[:-1]]
        x, delay, _ = self.solve(blocks, essential=chosen["essential"])
        result = self.model(x, delay, chosen["width"])
        result["chosen"] = {**chosen, "left": score(chosen)}
        return result


# ---------------------------------------------------------------- faultline's result

def identified_model(toml, report):
    """Numbers in the order of full_regressor from faultline's identified robot and its report."""
    identified = tomllib.loads(pathlib.Path(toml).read_text())["identified"]
    report = json.loads(pathlib.Path(report).read_text())
    joints = identified["joint"]
    links = [number for j in joints for number in [j["mass"], *j["first_moment"], *j["inertia"]]]
    own = [j[key] for key in ("rotor_inertia", "viscous", "coulomb", "offset") for j in joints]
    bends = [(j.get("bend", 0.0), j.get("bend_width", 1.0), j.get("skew", 0.0)) for j in joints]
    delay = report.get("torque_delay_s", identified.get("torque_delay_s"))
    if delay is None:
        period = max(log["sample_period_s"] for log in report["logs"])
        delay = (0.5 - identified.get("torque_phi", 0.5)) * period
    delay = delay if isinstance(delay, list) else [delay] * len(joints)
    return {"numbers": links + own, "width": [j["width"] for j in joints], "bends": bends,
            "load": [j.get("load", 0.0) for j in joints], "ripples": identified.get("ripple", []),
            "shared": identified.get("shared_drive", []),
            "gain": identified.get("torque_gain", [1.0] * len(joints)),
            "delay": [d or 0.0 for d in delay]}


# ---------------------------------------------------------------- what is fitted and what is held out

def write(path, names, table):
    np.savetxt(path, table, delimiter=",", header=",".join(names), comments="", fmt="%.10g")
    return path


def prepare(name, data, folder):
    """Paths of the logs to fit and of those held out."""
    pendulum = data / "double-pendulum"
    if name in ("acrobot", "pendubot"):
        logs = sorted(pendulum.glob(f"{name}_undisturbed_*.csv"))
        return logs[:-1], logs[-1:]
    if name == "double_pendulum":
        path = pendulum / "both_joints_75s.csv"
        names = [c.strip() for c in open(path).readline().split(",")]
        table = np.loadtxt(path, delimiter=",", skiprows=1)
        early = table[:, 0] < 50.0
        return ([write(folder / "fit.csv", names, table[early])],
                [write(folder / "held.csv", names, table[~early])])
    if name == "emps":
        path = data / "emps" / "DATA_EMPS.csv"
        return [path], [path]
    # Positions are the motors', in rad, and currents count as torque before the gears; motor 6 turns with
    # axes 5 and 6.
    load = lambda file: np.loadtxt(data / "staubli-tx40" / file, delimiter=",", skiprows=1)
    gears = np.diag([32.0, 32.0, 45.0, -48.0, 45.0, 32.0])
    gears[5, 4] = 32.0
    q = np.linalg.solve(gears, load("pos_read_data.csv").T).T
    tau = load("curr_data.csv") @ gears
    q, tau = (decimate(x, 5, ftype="fir", axis=0, zero_phase=True) for x in (q, tau))
    t = np.arange(len(q)) / 1000.0
    table = np.column_stack([t, q, tau])
    names = ["t"] + [f"{kind}{j + 1}" for kind in ("q", "tau") for j in range(6)]
    cut = lambda a, b: table[(t >= a) & (t < b)]
    return ([write(folder / "fit.csv", names, cut(0.1, 3.8))],
            [write(folder / "held.csv", names, cut(3.8, 7.5))])


# ---------------------------------------------------------------- runs and tables

def timed(command, log):
    """Processor seconds of a command; findings are no failure."""
    with open(log, "w") as out:
        job = subprocess.Popen([str(c) for c in command], stdout=out, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(job.pid, 0)
    job.returncode = os.waitstatus_to_exitcode(status)
    if job.returncode not in (0, 1):
        sys.exit(f"identify_real: status {job.returncode} of {command[0]} {command[1]}, see {log}")
    return usage.ru_utime + usage.ru_stime


def compare(name, arguments):
    folder = pathlib.Path(arguments.out) / name
    folder.mkdir(parents=True, exist_ok=True)
    file = HERE / "robots" / f"{name}.toml"
    robot = Robot(file)
    fitted, held = prepare(name, pathlib.Path(arguments.data), folder)
    held = [read_log(robot, path) for path in held]
    models, seconds = {}, {}
    toml, report = folder / "identified.toml", folder / "identified.json"
    seconds["faultline"] = timed([arguments.faultline, "identify", *fitted, "--robot", file, "-o", toml,
                                  "--json", report, "--threads", "1"], folder / "faultline.txt")
    models["faultline"] = identified_model(toml, report)
    for label in ["peer"] + (["peer, motor 6 coupled"] if name == "staubli_tx40" else []):
        out = folder / (label.replace(", ", "_").replace(" ", "_") + ".json")
        coupled = ["--coupled", "4", "5"] if "coupled" in label else []
        seconds[label] = timed([sys.executable, __file__, "--peer", name, *coupled, "--out", out, *fitted],
                               folder / "peer.txt")
        models[label] = json.loads(out.read_text())
    table(name, robot, models, {label: judge(robot, held, m, name) for label, m in models.items()}, seconds)


def table(name, robot, models, judged, seconds):
    held = "all samples, none held out" if name == "emps" else "held out"
    print(f"\n### {name} ({held})\n")
    labels = list(models)
    units = [f"{what}, {l}" for what in ("R2", "R2 moving", "rms left", "delay ms") for l in labels]
    print("| joint | " + " | ".join(units) + " |\n|---" + "|---" * len(units) + "|")
    for j in range(robot.n):
        row = [f"{judged[l][key][j]:.4f}" for key in ("all", "moving", "rms") for l in labels]
        row += [f"{1000 * models[l]['delay'][j]:.1f}" for l in labels]
        print(f"| {j + 1} | " + " | ".join(row) + " |")
    print("\nprocessor time: " + ", ".join(f"{l} {seconds[l]:.2f} s" for l in labels))
    for label, model in models.items():
        if "chosen" in model:
            chosen = model["chosen"]
            velocity = "logged" if chosen["logged_velocity"] else "from positions"
            print(f"{label}: motion below {chosen['motion_hz']:g} Hz, torque below "
                  f"{chosen['torque_hz']:g} Hz, "
                  f"velocity {velocity}, Coulomb width {chosen['width']:.2g}, "
                  f"{'essential' if chosen['essential'] else 'all base'} parameters")
    if name == "emps":
        published = [95.1089, 203.5034, 20.3935, -3.1648]
        print("\n| | M | Fv | Fc | offset |\n|---|---|---|---|---|")
        for label, model in models.items():
            v = model["numbers"]
            found = [v[0] + v[10], v[11], v[12], v[13]]
            errors = " | ".join(f"{100 * (f / p - 1):+.2f} %" for f, p in zip(found, published))
            print(f"| {label} | {errors} |")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--faultline", default="build/release/faultline")
    parser.add_argument("--data", default="../shared/data")
    parser.add_argument("--out", default="out/identify-real")
    parser.add_argument("--peer", metavar="ROBOT", help="fit the peer alone, to the logs named")
    parser.add_argument("--coupled", type=int, nargs=2)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    if arguments.peer:
        robot = Robot(HERE / "robots" / f"{arguments.peer}.toml")
        logs = [read_log(robot, path) for path in arguments.names]
        result = Peer(robot, arguments.peer, arguments.coupled).fit(logs)
        pathlib.Path(arguments.out).write_text(json.dumps(result))
        return
    unknown = set(arguments.names) - set(JUDGE)
    if unknown:
        parser.error(f"no robot {', '.join(sorted(unknown))}")
    for name in arguments.names or JUDGE:
        compare(name, arguments)


if __name__ == "__main__":
    main()
