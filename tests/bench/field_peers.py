#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The peers of field.py: each learns from healthy logs and gives each row of a log a score; above 1 is an alarm.

The limit of a peer is MARGIN times its largest score in the healthy logs, so that it would have raised no alarm in
them. What a peer fits is judged on healthy logs that it did not fit (each left out in turn, or half of a single one).
"""
import tomllib

import numpy as np

MARGIN = 1.1
AVERAGED_S = 0.05  # scores of single rows are averaged over so long: the latest rows
OBSERVER_GAIN = 25.0  # 1/s, of the momentum observer
ROWS_FITTED = {"forest": 20000, "svm": 3000, "mahalanobis": 10 ** 9}


def averaged(score, log):
    """The mean of the latest rows."""
    rows = max(1, round(AVERAGED_S / np.median(np.diff(log.t))))
    sums = np.concatenate([np.zeros(rows), np.cumsum(score)])
    count = np.minimum(np.arange(1, len(score) + 1), rows)
    return (sums[rows:] - sums[:-rows]) / count


class Robot:
    """Rigid-body dynamics of an identified robot file, for all rows at once."""

    def __init__(self, path):
        with open(path, "rb") as file:
            d = tomllib.load(file)
        self.gravity = np.array(d["gravity"])
        self.joints = d["joint"]
        self.bodies = d["identified"]["joint"]
        n = len(self.joints)
        self.gain = np.array(d["identified"].get("torque_gain", [1.0] * n))
        self.delay_s = d["identified"].get("torque_delay_s", [0.0] * n)
        self.ripples = d.get("ripple", []) + d["identified"].get("ripple", [])
        self.left_out = [key for key in ("shared_drive", "spring") if key in d or key in d["identified"]]

    def torque(self, q, dq, ddq, gravity):
        """Recursive Newton-Euler about the joints; the frames of all links are parallel to the base at q = 0."""
        rows, n = q.shape
        w, dw, a = np.zeros((rows, 3)), np.zeros((rows, 3)), np.tile(-gravity, (rows, 1))
        turns, places, forces, moments = [], [], [], []
        for j, joint in enumerate(self.joints):
            axis = np.array(joint["axis"])
            place = np.tile(np.array(joint.get("offset", [0, 0, 0]), float), (rows, 1))
            if j > 0:
                place += self.bodies[j - 1]["length"] * np.array(joint.get("direction", [0, 0, 0]))
            revolute = joint["kind"] == "revolute"
            if not revolute:
                place += q[:, j:j + 1] * axis
            turn = rotations(axis, q[:, j]) if revolute else np.tile(np.eye(3), (rows, 1, 1))
            a = back(turn, a + np.cross(dw, place) + np.cross(w, np.cross(w, place)))
            w, dw = back(turn, w), back(turn, dw)
            v, f = dq[:, j:j + 1] * axis, ddq[:, j:j + 1] * axis
            if revolute:
                dw = dw + f + np.cross(w, v)
                w = w + v
            else:
                a = a + 2 * np.cross(w, v) + f
            b = self.bodies[j]
            h, inertia = np.array(b["first_moment"]), tensor(b["inertia"])
            forces.append(b["mass"] * a + np.cross(dw, h) + np.cross(w, np.cross(w, h)))
            moments.append(dw @ inertia + np.cross(w, w @ inertia) + np.cross(h, a))
            turns.append(turn)
            places.append(place)
        out = np.zeros((rows, n))
        for j in reversed(range(n)):
            axis = np.array(self.joints[j]["axis"])
            out[:, j] = (moments[j] if self.joints[j]["kind"] == "revolute" else forces[j]) @ axis
            out[:, j] += self.bodies[j].get("rotor_inertia", 0.0) * ddq[:, j]
            if j > 0:
                force = np.einsum("nab,nb->na", turns[j], forces[j])
                moments[j - 1] += np.einsum("nab,nb->na", turns[j], moments[j]) + np.cross(places[j], force)
                forces[j - 1] += force
        return out

    def friction(self, q, dq, carried):
        out = np.zeros_like(dq)
        for j, b in enumerate(self.bodies):
            v = dq[:, j]
            way = np.tanh(v / b.get("width", 0.01))
            out[:, j] = b.get("viscous", 0.0) * v + b.get("coulomb", 0.0) * way + b.get("offset", 0.0)
            out[:, j] += b.get("bend", 0.0) * np.tanh(v / b.get("bend_width", 1.0)) + b.get("skew", 0.0) * np.abs(v)
            out[:, j] += b.get("load", 0.0) * np.abs(carried[:, j]) * way
        for r in self.ripples:
            j = r["joint"] - 1
            out[:, j] += r["cosine"] * np.cos(r["rate"] * q[:, j]) + r["sine"] * np.sin(r["rate"] * q[:, j])
        return out

    def observer(self, log):
        """Residual of a momentum observer, rows x joints, N m or N: a first-order filter of the external torque."""
        q, dq, none = log.q, log.dq, np.zeros_like(log.q)
        weightless = np.zeros(3)
        tau = np.column_stack([np.interp(log.t - self.delay_s[j], log.t, self.gain[j] * log.tau[:, j])
                               for j in range(q.shape[1])])
        step = 1e-4
        momentum = self.torque(q, none, dq, weightless)
        change = (self.torque(q + step * dq, none, dq, weightless)
                  - self.torque(q - step * dq, none, dq, weightless)) / (2 * step)
        held = self.torque(q, dq, none, self.gravity)
        carried = self.torque(q, dq, np.gradient(dq, log.t, axis=0), self.gravity)
        known = tau - self.friction(q, dq, carried) + change - held
        out, total = np.zeros_like(q), np.zeros(q.shape[1])
        for k in range(1, len(log.t)):
            dt = log.t[k] - log.t[k - 1]
            total += 0.5 * (known[k] + known[k - 1]) * dt
            # r = K (p - p0 - total - integral of r), with r at the end of the step
            out[k] = OBSERVER_GAIN * (momentum[k] - momentum[0] - total) / (1 + OBSERVER_GAIN * dt)
            total += out[k] * dt
        ahead_s = max(0.0, -min(self.delay_s))  # a torque that was logged too late is read ahead
        return np.column_stack([np.interp(log.t - ahead_s, log.t, r) for r in out.T]) if ahead_s else out


def rotations(axis, angle):
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle)[:, None, None] * k + (1 - np.cos(angle))[:, None, None] * (k @ k)


def back(turn, vector):
    return np.einsum("nab,na->nb", turn, vector)


def tensor(i):
    return np.array([[i[0], i[3], i[4]], [i[3], i[1], i[5]], [i[4], i[5], i[2]]])


class LargestOfJoints:
    """Largest of the residuals of a log, each by its limit from the healthy logs: no fit, or one done before."""

    def __init__(self, residual_of, healthy):
        self.residual_of = residual_of
        self.limit = MARGIN * np.max([np.abs(residual_of(log)).max(axis=0) for log in healthy], axis=0)

    def score(self, log):
        return (np.abs(self.residual_of(log)) / self.limit).max(axis=1)


def tracking_error(log):
    n = log.q.shape[1]
    return np.column_stack([averaged(log.error[:, j], log) for j in range(n)])


def features(log):
    """What a table of a log has: position, velocity, its sign, acceleration, torque, and the errors of the loop."""
    ddq = np.gradient(log.dq, log.t, axis=0)
    parts = [np.sin(log.q), np.cos(log.q), log.dq, np.tanh(log.dq / 0.01), ddq, log.tau]
    return np.hstack(parts + ([] if log.error is None else [log.error]))


def mahalanobis(x):
    """All principal components, each by its standard deviation: constant ones count for nothing."""
    values, directions = np.linalg.eigh(np.cov(x, rowvar=False))
    kept = values > 1e-9 * values[-1]
    middle, white = x.mean(axis=0), directions[:, kept] / np.sqrt(values[kept])
    return lambda y: np.sqrt((((y - middle) @ white) ** 2).sum(axis=1))


def forest(x):
    from sklearn.ensemble import IsolationForest
    fitted = IsolationForest(n_estimators=100, random_state=0).fit(x)
    return lambda y: -fitted.score_samples(y)


def svm(x):
    from sklearn.svm import OneClassSVM
    fitted = OneClassSVM(nu=0.01, gamma="scale").fit(x)
    highest = fitted.score_samples(x).max()
    return lambda y: highest - fitted.score_samples(y)


class OfRows:
    """A method that learns what rows are usual."""

    def __init__(self, method, healthy):
        self.method = method
        tables = [features(log) for log in healthy]
        if len(tables) == 1:
            parts = [(tables[0][k * len(tables[0]) // 2:(k + 1) * len(tables[0]) // 2], healthy[0]) for k in range(2)]
        else:
            parts = list(zip(tables, healthy))
        self.limit = 0.0
        for k, (rows, log) in enumerate(parts):
            score = self.fit([part for i, (part, _) in enumerate(parts) if i != k])
            self.limit = max(self.limit, MARGIN * averaged(score(rows), log).max())
        self.score_of = self.fit(tables)

    def fit(self, tables):
        x = np.vstack(tables)
        middle, scale = x.mean(axis=0), x.std(axis=0) + 1e-12
        x = (x - middle) / scale
        if len(x) > ROWS_FITTED[self.method.__name__]:
            x = x[np.random.default_rng(0).choice(len(x), ROWS_FITTED[self.method.__name__], replace=False)]
        fitted = self.method(x)
        return lambda y: fitted((y - middle) / scale)

    def score(self, log):
        return averaged(self.score_of(features(log)), log) / self.limit


def has_sklearn():
    try:
        import sklearn  # noqa: F401
    except ImportError:
        return False
    return True


def peers(identified, healthy):
    """Yields (name, peer) of all that these logs and this machine allow. `identified`: robot file, or None."""
    if identified is not None:
        yield "momentum observer", LargestOfJoints(Robot(identified).observer, healthy)
    if healthy[0].error is not None:
        yield "tracking error", LargestOfJoints(tracking_error, healthy)
    yield "Mahalanobis", OfRows(mahalanobis, healthy)
    if has_sklearn():
        yield "IsolationForest", OfRows(forest, healthy)
        yield "one-class SVM", OfRows(svm, healthy)
