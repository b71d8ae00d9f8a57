#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The logs of field.py: those of the shared folder, a simulated joint at constant speed, and what the program writes.

A group is one robot with its healthy logs, and the logs to judge: of a log with one fault the onset is known, of a log
with several collisions their begins and ends.
"""
import csv
import ctypes
import math
import pathlib
import struct
from dataclasses import dataclass, field

import numpy as np

NEVER = float("inf")


@dataclass
class Event:
    begin: float
    end: float = NEVER
    kind: str = "collision"
    joint: int = 0  # 0: not known
    strength: float = float("nan")  # to rank the events of a group: see field.py


@dataclass
class Log:
    path: pathlib.Path
    t: np.ndarray
    q: np.ndarray  # rows x joints, SI, as dq and tau
    dq: np.ndarray
    tau: np.ndarray
    error: np.ndarray = None  # q_ref - q and dq_ref - dq beside each other; None without references
    events: list = field(default_factory=list)

    def hours_without_event(self):
        busy = sum(min(e.end, self.t[-1]) - max(e.begin, self.t[0]) for e in self.events)
        return (self.t[-1] - self.t[0] - busy) / 3600

    def is_busy(self):
        """By row: whether an event lasts."""
        return np.any([(self.t >= e.begin) & (self.t <= e.end) for e in self.events] or [self.t < -NEVER], axis=0)


@dataclass
class Group:
    name: str
    robot: str  # the text of its robot file
    healthy: list
    test: list
    numbers: tuple = (1,)  # of healthy logs to learn from, the largest last
    has_one_fault: bool = False  # a log of `test` has one fault that lasts, or is healthy
    by_row: bool = True  # rows of events and others are ranked, too
    beside: list = field(default_factory=list)  # healthy logs of another day to judge apart


def read_columns(path):
    with open(path, newline="", encoding="utf-8") as file:
        names = next(csv.reader(file))
    values = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    return {name: values[:, k] for k, name in enumerate(names)}


def joints_of(columns, prefix, scale=1.0):
    names = sorted((n for n in columns if n[:-1] == prefix and n[-1].isdigit()), key=lambda n: int(n[-1]))
    return scale * np.column_stack([columns[n] for n in names]) if names else None


def plain_log(path, events=()):
    """A log whose columns have the usual names."""
    c = read_columns(path)
    q, dq, q_ref, dq_ref = (joints_of(c, name) for name in ("q", "dq", "q_ref", "dq_ref"))
    error = None if q_ref is None else np.hstack([q_ref - q, dq_ref - dq])
    return Log(pathlib.Path(path), c["t"], q, dq, joints_of(c, "tau"), error, list(events))


def living(data):
    """One group a cell of living robots."""
    if not (data / "living" / "labels.csv").exists():
        print("There are no logs of living robots in the shared folder: they are left out.\n")
        return []
    with open(data / "living" / "labels.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    groups = []
    for cell, l1 in (("A", 0.35), ("B", 0.25), ("C", 1.0)):
        logs = {"learn": [], "test": []}
        for row in rows:
            if row["cell"] != cell:
                continue
            # Whatever joint a changed payload is labelled with, it is at the tip.
            joint = 3 if row["fault"] == "payload_change" else int(row["joint"] or 0)
            faults = [] if row["fault"] == "none" else [Event(float(row["onset_s"]), NEVER, row["fault"], joint)]
            logs[row["use"]].append(plain_log(data / "living" / row["file"], faults))
        robot = f'axes = "RRP"\n\n[known]\nl1 = {l1}\n\n[log]\ntorque = "commanded"\n'
        groups.append(Group(f"living {cell}", robot, logs["learn"], logs["test"], (1, 2, 3, 6), has_one_fault=True,
                            by_row=False))
    return groups


def doosan(data):
    """The real arm with six axes, by the torque of its joints and by the current of its motors."""
    if not (data / "doosan" / "labels.csv").exists():
        print("There are no logs of the six-axis arm (doosan) in the shared folder: they are left out.\n")
        return []
    with open(data / "doosan" / "labels.csv", newline="", encoding="utf-8") as file:
        events = [(float(row["onset_s"]), float(row["end_s"])) for row in csv.DictReader(file)]
    groups = []
    for name, channel, robot in (("doosan, torque", "joint_torque", "doosan_m0609"),
                                 ("doosan, current", "current", "doosan_m0609_current")):
        logs = []
        for file in ("free.csv", "collisions.csv", "joint_free.csv"):
            c = read_columns(data / "doosan" / file)
            deg = np.pi / 180
            q, dq, q_ref, dq_ref = (joints_of(c, p, deg) for p in ("q_deg", "dq_deg_s", "q_ref_deg", "dq_ref_deg_s"))
            logs.append(Log(data / "doosan" / file, c["time"], q, dq, joints_of(c, channel),
                            np.hstack([q_ref - q, dq_ref - dq])))
        logs[1].events = [Event(*event) for event in events]
        text = pathlib.Path(f"tests/bench/robots/{robot}.toml").read_text(encoding="utf-8")
        groups.append(Group(name, text, logs[:1], logs[1:2], beside=logs[2:]))
    return groups


# The joint at constant speed: 1 kHz control, logged at 125 Hz.
CONTROL_S, EACH = 0.001, 8
INERTIA, CONSTANT = 2.0, 10.0  # kg m^2 with the rotor, N m/A at the joint
COULOMB, VISCOUS = 8.0, 6.0  # N m, N m s/rad
SPEED, TRAVEL = 0.5, 1.5  # rad/s, rad
RIPPLE = ((36.0, 0.10, 0.7), (100.0, 0.05, 2.1))  # 1/rad, A, rad: by the position, the same in all logs
NOISE_A, CODE = 0.03, 2e-5  # of the current, A; of the encoder, rad


def constant_speed_log(path, duration_s, seed, contacts=()):
    """Simulates one joint back and forth at constant speed under a PID loop and writes its log. `contacts` are
    (begin s, length s, N m): a half sine against the motion."""
    rng = np.random.default_rng(seed)
    friction = rng.normal(1.0, 0.05)
    blow = np.zeros(int(duration_s / CONTROL_S))
    for begin, length, torque in contacts:
        k = np.arange(int(begin / CONTROL_S), int((begin + length) / CONTROL_S))
        blow[k] = torque * np.sin(np.pi * (k * CONTROL_S - begin) / length)
    blow, noise = blow.tolist(), rng.normal(0, NOISE_A, blow.size).tolist()
    half_s, ramp = TRAVEL / SPEED, 0.2
    q = dq = dq_ref = q_ref = total = 0.0
    rows = []
    for k in range(len(blow)):
        t = k * CONTROL_S
        way = 1.0 if (t // half_s) % 2 == 0 else -1.0
        most = SPEED / ramp * CONTROL_S
        dq_ref += min(max(way * SPEED - dq_ref, -most), most)
        q_ref += dq_ref * CONTROL_S
        seen = round(q / CODE) * CODE
        total += (q_ref - seen) * CONTROL_S
        current = (8000 * (q_ref - seen) + 250 * (dq_ref - dq) + 20000 * total) / CONSTANT
        ripple = sum(a * math.sin(n * q + p) for n, a, p in RIPPLE)
        drag = friction * (COULOMB * math.tanh(dq / 0.01) + VISCOUS * dq)
        if k % EACH == 0:
            rows.append((t, seen, dq + 1e-4 * rng.normal(), current + noise[k], q_ref, dq_ref))
        dq += (CONSTANT * (current - ripple) - drag - math.copysign(blow[k], dq)) / INERTIA * CONTROL_S
        q += dq * CONTROL_S
    np.savetxt(path, rows, delimiter=",", fmt="%.9g", header="t,q1,dq1,tau1,q_ref1,dq_ref1", comments="")
    return plain_log(path, [Event(b, b + length, joint=1, strength=torque) for b, length, torque in contacts])


def constant_speed(folder):
    """The group of that joint: 46 contacts of 1 to 16 N m in eight logs, as many healthy ones, six to learn from."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(1)
    strengths = list(rng.permutation(np.geomspace(1.0, 16.0, 46)))
    healthy = [constant_speed_log(folder / f"healthy_{k}.csv", 30.0, 10 + k) for k in range(6)]
    test = [constant_speed_log(folder / f"other_{k}.csv", 40.0, 30 + k) for k in range(8)]
    for k in range(8):
        number = 6 if k < 6 else 5
        contacts = [(4.0 + 6.0 * i + rng.uniform(0, 2.5), rng.uniform(0.1, 0.3), strengths.pop())
                    for i in range(number)]
        test.append(constant_speed_log(folder / f"contacts_{k}.csv", 40.0, 50 + k, contacts))
    robot = 'axes = "R"\n\n[log]\ntorque = "current"\n'
    return [Group("constant speed", robot, healthy, test, (1, 2, 3, 6))]


def mcap_messages(path):
    """Yields (topic, log time in s, bytes) of the messages of an MCAP file as the program writes it."""
    zstd = ctypes.CDLL("libzstd.so.1")
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    zstd.ZSTD_decompress.argtypes = (ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t)
    topics = {}

    def records(data):
        at = 0
        while at + 9 <= len(data):
            size = struct.unpack_from("<Q", data, at + 1)[0]
            yield data[at], data[at + 9:at + 9 + size]
            at += 9 + size

    def messages(data):
        for op, body in records(data):
            if op == 4:  # channel: id, schema, topic
                length = struct.unpack_from("<I", body, 4)[0]
                topics[struct.unpack_from("<H", body)[0]] = body[8:8 + length].decode()
            elif op == 5:  # message: channel, sequence, log time, publish time
                channel, _, time, _ = struct.unpack_from("<HIQQ", body)
                yield topics[channel], 1e-9 * time, body[22:]
            elif op == 6:  # chunk: start, end, size, crc, compression, records
                size, length = struct.unpack_from("<Q", body, 16)[0], struct.unpack_from("<I", body, 28)[0]
                inner = body[32 + length + 8:]
                if length:
                    out = ctypes.create_string_buffer(size)
                    if zstd.ZSTD_decompress(out, size, inner, len(inner)) != size:
                        raise ValueError(f"{path}: a chunk is damaged")
                    inner = out.raw
                yield from messages(inner)

    yield from messages(path.read_bytes()[8:])


def joint_state(data):
    """Returns position, velocity and effort of a sensor_msgs/msg/JointState in CDR, little endian."""
    at = 4 + 8  # encapsulation; stamp
    align = lambda n, size: 4 + -(-(n - 4) // size) * size

    def text(at):
        at = align(at, 4)
        return at + 4 + struct.unpack_from("<I", data, at)[0]

    at = text(at)
    at = align(at, 4)
    names, at = struct.unpack_from("<I", data, at)[0], at + 4
    for _ in range(names):
        at = text(at)
    out = []
    for _ in range(3):
        at = align(at, 4)
        count, at = struct.unpack_from("<I", data, at)[0], at + 4
        if count:
            at = align(at, 8)
        out.append(np.frombuffer(data, "<f8", count, at))
        at += 8 * count
    return out


def torque_residuals(recording):
    """Returns times and residual torques (rows x joints) by `faultline diagnose --mcap`: logged less required."""
    logged, required = {}, {}
    for topic, time, data in mcap_messages(recording):
        if topic == "/joint_states":
            logged[round(time, 7)] = joint_state(data)[2]
        elif topic == "/faultline/predicted":
            required[round(time, 7)] = joint_state(data)[2]
    times = [t for t in sorted(required) if t in logged and len(required[t]) == len(logged[t])]
    return np.array(times), np.array([logged[t] - required[t] for t in times])
