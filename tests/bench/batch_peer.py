#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The batch job as a script with pandas, numpy and scikit-learn would do it, to compare times with faultline batch.

    apt-get install python3-pandas python3-sklearn
    python3 tests/bench/batch_peer.py FOLDER [LOGS] [--samples]

Reads each log, makes both residuals that faultline makes of a sample, classifies them and writes a row a log:
  - regenerated motion: an MLPRegressor from (q, dq, tau) to the change of (q, dq), over the whole log at once;
  - innovations of a Kalman filter that follows the log with the rigid-body model, sample by sample, with chi-square
    and log likelihood of each joint (but no bank of fault hypotheses, which faultline runs after an alarm);
  - an MLPClassifier over features of both (a window each), and a run of alarms long enough as a finding.
With --samples the filter is left out, as in the paper (compare with faultline batch --classify samples). Training
uses one log and is not what is measured: it is small, and its time is printed.
"""
import json
import os
import pathlib
import sys
import time
import warnings

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one log a core, as faultline --threads 1
import numpy as np
import pandas as pd
from sklearn.neural_network import MLPClassifier, MLPRegressor

warnings.filterwarnings("ignore")

# The industrial robot of sample_logs as it was simulated: masses, lengths, friction.
M, L = np.array([9.0, 6.0, 2.0]), np.array([0.4, 0.3])
VISCOUS, COULOMB, WIDTH = np.array([2.5, 1.2, 15.0]), np.array([3.5, 2.2, 6.0]), np.array([0.02, 0.02, 0.01])
GRAVITY, WINDOW, RUN = 9.81, 100, 50
Q_STD, DQ_STD = np.array([5e-5, 5e-5, 1e-5]), np.array([4e-3, 4e-3, 8e-4])


def acceleration(q, dq, tau):
    """Rods of uniform mass on two revolute axes, a lifting mass at the tip. With it the inverse inertia."""
    b = M[1] / 3 + M[2]
    c2, s2 = np.cos(q[1]), np.sin(q[1])
    cross = (M[1] / 2 + M[2]) * L[0] * L[1]
    m11 = (M[0] / 3 + M[1] + M[2]) * L[0] ** 2 + b * L[1] ** 2 + 2 * cross * c2
    m12, m22 = b * L[1] ** 2 + cross * c2, b * L[1] ** 2
    free = tau - VISCOUS * dq - COULOMB * np.tanh(dq / WIDTH)
    f1 = free[0] + cross * s2 * (2 * dq[0] + dq[1]) * dq[1]
    f2 = free[1] - cross * s2 * dq[0] ** 2
    det = m11 * m22 - m12 * m12
    inverse = np.array([[m22 / det, -m12 / det, 0], [-m12 / det, m11 / det, 0], [0, 0, 1 / M[2]]])
    return inverse @ np.array([f1, f2, free[2] - M[2] * GRAVITY]), inverse


def innovations(t, q, dq, tau):
    """Whitened by their standard deviations, and chi-square and log likelihood of each joint: rows x 12."""
    n = len(t)
    out = np.zeros((n, 12))
    x, p = np.concatenate([q[0], dq[0]]), np.diag(np.concatenate([Q_STD, DQ_STD]) ** 2)
    r = p.copy()
    f, noise = np.eye(6), np.diag([1e-14] * 3 + [1e-8] * 3)
    measured = np.hstack([q, dq])
    for k in range(1, n):
        h = t[k] - t[k - 1]
        a1, inverse = acceleration(x[:3], x[3:], tau[k - 1])
        middle = x[3:] + 0.5 * h * a1
        a2, _ = acceleration(x[:3] + 0.5 * h * x[3:], middle, tau[k - 1])
        slope = VISCOUS + COULOMB / WIDTH / np.cosh(np.clip(x[3:] / WIDTH, -300, 300)) ** 2
        x = np.concatenate([x[:3] + h * middle, x[3:] + h * a2])
        f[:3, 3:] = h * np.eye(3)
        f[3:, 3:] = np.linalg.inv(np.eye(3) + h * inverse * slope)
        p = f @ p @ f.T + noise
        s = p + r
        nu = measured[k] - x
        out[k, :6] = nu / np.sqrt(np.diag(s))
        for j in range(3):
            pair = s[j::3, j::3]
            chi = min(nu[j::3] @ np.linalg.solve(pair, nu[j::3]), 36.0)
            out[k, 6 + j], out[k, 9 + j] = chi, -0.5 * (chi + np.log(np.linalg.det(pair)))
        gain = np.linalg.solve(s, p).T
        x = x + gain @ nu
        p = p - gain @ p
    return out


def read(path):
    table = pd.read_csv(path)
    pick = lambda name: table[[f"{name}{j}" for j in (1, 2, 3)]].to_numpy()
    return table["t"].to_numpy(), pick("q"), pick("dq"), pick("tau")


def windowed(values):
    frame = pd.DataFrame(values)
    return np.hstack([frame.rolling(WINDOW, min_periods=1).mean(), (frame**2).rolling(WINDOW, min_periods=1).mean()])


class Peer:
    def __init__(self, with_filter):
        self.with_filter = with_filter

    def inputs(self, log):
        return np.hstack(log[1:])

    def learn(self, log):
        t, q, dq, tau = log
        x, y = self.inputs(log)[:-1], np.hstack([np.diff(q, axis=0), np.diff(dq, axis=0)])
        self.x_mean, self.x_std = x.mean(0), x.std(0)
        self.y_mean, self.y_std = y.mean(0), y.std(0)
        self.net = MLPRegressor((24,), activation="tanh", max_iter=60, random_state=1)
        self.net.fit((x - self.x_mean) / self.x_std, (y - self.y_mean) / self.y_std)
        features = self.features(log)
        rng = np.random.default_rng(1)
        label = rng.integers(0, 10, len(features))  # as many classes as faults; what it learns changes no time
        self.judge = MLPClassifier((24,), activation="tanh", max_iter=3, random_state=1).fit(features, label)

    def features(self, log):
        t, q, dq, tau = log
        predicted = self.net.predict((self.inputs(log)[:-1] - self.x_mean) / self.x_std)
        change = (np.hstack([np.diff(q, axis=0), np.diff(dq, axis=0)]) - self.y_mean) / self.y_std
        parts = [windowed(change - predicted)]
        if self.with_filter:
            parts.append(windowed(innovations(t, q, dq, tau)[1:]))
        return np.hstack(parts)

    def row(self, path):
        log = read(path)
        share = self.judge.predict_proba(self.features(log))
        alarm = pd.Series((share[:, 1:].max(1) > 0.9).astype(float)).rolling(RUN).sum() >= RUN
        first = int(alarm.to_numpy().argmax()) if alarm.any() else None
        return {"log": path.name, "rows": len(log[0]), "faulty": bool(alarm.any()),
                "alarm_s": None if first is None else float(log[0][first])}


def main():
    arguments = [a for a in sys.argv[1:] if a != "--samples"]
    paths = sorted(p for p in pathlib.Path(arguments[0]).rglob("*.csv") if p.name != "labels.csv")
    paths = paths[: int(arguments[1])] if len(arguments) > 1 else paths
    peer = Peer("--samples" not in sys.argv)
    start = time.process_time()
    peer.learn(read(paths[0]))
    trained = time.process_time()
    for path in paths:
        print(json.dumps(peer.row(path)))
    print(f"{trained - start:.2f} s training, {(time.process_time() - trained) / len(paths):.3f} s a log",
          file=sys.stderr)


if __name__ == "__main__":
    main()
