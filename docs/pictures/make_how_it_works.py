#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the three pictures of docs/how-it-works.md from the logs of sample_logs/industrial.

    FAULTLINE=build/release/faultline python3 docs/pictures/make_how_it_works.py [FOLDER]

FOLDER is docs/pictures by default; the script writes how-it-works-rows.svg, how-it-works-days.svg and how-it-works-scores.svg
into it. The script needs the Debian packages python3-numpy and python3-matplotlib, and the program `faultline`, which only
converts the logs to CSV here. The run takes some seconds, and the same input gives the same bytes.

The numbers come from a short implementation of the equations of the page for an RRP robot, written apart from lib/:

- equation (1): momentum balance between neighbouring samples, torque held over each sample, Gaussian kernel of 12 ms, a row
  every 24 ms; the columns are the base parameters a, b, c, m3 and the friction of each joint;
- equation (2): the effects of a day with the prior standard deviations of a day that was never seen; the gain and the offset
  of joint 3, which carries its weight, are left out;
- equations (3) and (4): a constant variance for each joint with .4 % of each term of the model, and an autoregression of order
  3; the program has more terms;
- equations (5), (6) and (9): evidence of the columns of a fault from an onset on;
- equation (7): ordinary least squares over the three healthy logs stands for the fit over days.
"""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("svg")
from matplotlib import pyplot as plt  # noqa: E402 (after the choice of what draws)

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOGS = ROOT / "sample_logs/industrial"
HEALTHY = ["healthy_1", "healthy_2", "healthy_3"]
FAULTY, JOINT = "friction_increase_2", 1  # joint from 0
ONSET_S = 1.9529  # as labels.csv has it

KERNEL_S, FRICTION_KERNEL_S, ROW_SAMPLES, ORDER = 0.012, 0.006, 24, 3
WIDTH = np.array([0.02, 0.02, 0.01])  # rad/s and m/s of tanh(dq / width)
MODEL_SHARE = 0.004  # of each term of the model: what the model of a machine lacks
INERTIA_STD, FRICTION_STD, GAIN_STD, OFFSET_SHARE = 0.01, 0.05, 0.01, 5e-3  # effects of a day
GRAVITY = 9.81
BLUE, ORANGE, GREEN, PURPLE, GREY = "#0072b2", "#d55e00", "#009e73", "#8d5fa8", "#6b7078"


def read(name):
    """Time, q, dq and torque of a log; each but the time is rows x 3."""
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "log.csv"
        subprocess.run([os.environ.get("FAULTLINE", ROOT / "build/release/faultline"), "convert",
                        LOGS / f"{name}.flog", table], check=True, stdout=subprocess.DEVNULL)
        with open(table, newline="", encoding="utf-8") as file:
            values = np.array([[float(cell) for cell in row] for row in list(csv.reader(file))[1:]])
    return values[:, 0], values[:, 1:4], values[:, 4:7], values[:, 7:10]


def kernel(sigma_s, period_s):
    reach = int(np.ceil(4 * sigma_s / period_s))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) * period_s / sigma_s) ** 2)
    return weights / weights.sum()


def smooth(values, weights):
    reach = len(weights) // 2
    padded = np.pad(values, [(reach, reach)] + [(0, 0)] * (values.ndim - 1), mode="edge")
    return np.apply_along_axis(lambda column: np.convolve(column, weights, "valid"), 0, padded)


def fused_velocity(q, dq, period_s):
    """The logged velocity, whose slow part comes from the positions: each where it is more precise."""
    decay = np.exp(-80.0 * period_s)  # standard deviation of dq over that of q
    lags = np.arange(-60, 61)
    weights = decay ** np.abs(lags)
    return dq + smooth(np.gradient(q, period_s, axis=0) - dq, weights / weights.sum())


class Rows:
    """The torque balance of one log: torque is rows x 3, column[j] is rows x 10 (a, b, c, m3, fv 1..3, fc 1..3)."""

    def __init__(self, name):
        self.t, q, dq, self.tau = read(name)
        h = self.t[1] - self.t[0]
        v = fused_velocity(q, dq, h)
        cos, sin, zero = np.cos(q[:, 1]), np.sin(q[:, 1]), np.zeros(len(q))
        momentum = [np.stack([v[:, 0], v[:, 0] + v[:, 1], 2 * cos * v[:, 0] + cos * v[:, 1], zero], 1),
                    np.stack([zero, v[:, 0] + v[:, 1], cos * v[:, 0], zero], 1),
                    np.stack([zero, zero, zero, v[:, 2]], 1)]
        force = [np.zeros((len(q), 4)),
                 np.stack([zero, zero, -sin * v[:, 0] * (v[:, 0] + v[:, 1]), zero], 1),
                 np.stack([zero, zero, zero, np.full(len(q), -GRAVITY)], 1)]
        speed = smooth(v, kernel(FRICTION_KERNEL_S, h))
        speed = 0.5 * (speed[1:] + speed[:-1])
        weights = kernel(KERNEL_S, h)
        first = len(weights) // 2 + len(kernel(FRICTION_KERNEL_S, h)) // 2 + 1
        self.at = np.arange(first, len(q) - 1 - first, ROW_SAMPLES)
        self.time_s = self.t[self.at] + 0.5 * h
        pick = lambda values: smooth(values, weights)[self.at]  # noqa: E731
        self.torque = pick(self.tau[:-1])
        self.column = []
        for j in range(3):
            base = np.diff(momentum[j], axis=0) / h - 0.5 * (force[j][1:] + force[j][:-1])
            friction = np.zeros((len(q) - 1, 6))
            friction[:, j], friction[:, 3 + j] = speed[:, j], np.tanh(speed[:, j] / WIDTH[j])
            self.column.append(pick(np.hstack([base, friction])))

    def predicted(self, theta):
        return np.stack([column @ theta for column in self.column], 1)

    def left(self, theta):
        return self.torque - self.predicted(theta)


def soft_step(rows, time_s):
    """0 before and 1 after, smoothed as the rows are (a normal distribution function)."""
    from math import erf
    return np.array([0.5 * (1 + erf((t - time_s) / (KERNEL_S * 2**0.5))) for t in rows.time_s])


def noise_of(days, theta):
    """By joint: standard deviation of a row and the autoregression of rows over it (Yule and Walker)."""
    out = []
    for j in range(3):
        left = [day.left(theta)[:, j] for day in days]
        std = np.sqrt(np.mean(np.concatenate(left) ** 2))
        lags = [sum(np.dot(x[:len(x) - k], x[k:]) for x in left) / sum(map(len, left)) / std**2 for k in range(ORDER + 1)]
        matrix = np.array([[lags[abs(i - k)] for k in range(ORDER)] for i in range(ORDER)])
        a = np.linalg.solve(matrix, lags[1:])
        out.append((std, np.concatenate([[1.0], -a]), np.sqrt(lags[0] - a @ lags[1:])))
    return out


def whitener(rows, theta, noise):
    """A function that makes white rows of unit variance of columns ([joint] -> rows x n), joint after joint."""
    stds = [np.sqrt(noise[j][0] ** 2 + MODEL_SHARE**2 * np.sum((rows.column[j] * theta) ** 2, 1)) for j in range(3)]

    def white(columns):
        parts = []
        for j in range(3):
            scaled = columns[j] / (noise[j][2] * stds[j][:, None])
            part = scaled.copy()
            for lag in range(1, ORDER + 1):
                part[lag:] += noise[j][1][lag] * scaled[:-lag]
            parts.append(part)
        return np.vstack(parts)
    return white


def regress(columns, rows, precision):
    """Estimate, covariance and log marginal likelihood (less what all hypotheses share)."""
    factor = np.linalg.cholesky(columns.T @ columns + np.diag(precision))
    vector = columns.T @ rows
    half = np.linalg.solve(factor, vector)
    inverse = np.linalg.inv(factor)
    likelihood = -0.5 * (rows @ rows - half @ half) + 0.5 * np.sum(np.log(precision)) - np.sum(np.log(np.diag(factor)))
    return inverse.T @ half, inverse.T @ inverse, likelihood


def day_columns(rows, theta, rms):
    """Effects of a day: inertia (4, relative), friction of each joint (3, relative), gain and offset of joints 1 and 2."""
    columns = []
    for j in range(3):
        out = np.zeros((len(rows.time_s), 11))
        out[:, :4] = rows.column[j][:, :4] * theta[:4]
        out[:, 4 + j] = rows.column[j][:, 4:] @ theta[4:]
        if j < 2:
            out[:, 7 + j] = rows.predicted(theta)[:, j]
            out[:, 9 + j] = 1.0
        columns.append(out)
    std = np.concatenate([np.full(4, INERTIA_STD), np.full(3, FRICTION_STD), np.full(2, GAIN_STD), OFFSET_SHARE * rms[:2]])
    return columns, std


def new_axes(height, panels, **more):
    plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "how-it-works", "font.size": 10, "axes.edgecolor": "#666666",
                         "axes.grid": True, "grid.color": "#e3e3e3", "axes.titlesize": 10, "axes.axisbelow": True})
    return plt.subplots(*panels, figsize=(7.6, height), **more)


def save(figure, folder, name, words):
    path = folder / f"how-it-works-{name}.svg"
    figure.savefig(path, facecolor="white", metadata={"Date": None})
    text = re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path.read_text("utf-8"))
    text = re.sub(r"'DejaVu Sans'[^;\"]*", "Helvetica, Arial, sans-serif", text)
    text = re.sub(r"<!DOCTYPE[^>]*>\n|\s*<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"(<svg[^>]*)>", lambda tag: f'{tag[1]} role="img">\n<title>{words}</title>', text, count=1)
    lines = [line.rstrip() for line in text.splitlines()]
    lines.insert(1, "<!-- SPDX-License-Identifier: MIT; made by docs/pictures/make_how_it_works.py -->")
    path.write_text("\n".join(lines) + "\n", "utf-8")
    print(path, path.stat().st_size, "bytes")


def draw_rows(day, theta, noise, folder):
    begin, end = 0.9, 2.9
    figure, (torque, left) = new_axes(4.6, (2, 1), sharex=True, gridspec_kw={
        "height_ratios": [2.2, 1], "left": 0.095, "right": 0.985, "top": 0.915, "bottom": 0.11, "hspace": 0.09})
    shown = (day.t >= begin) & (day.t <= end)
    at = (day.time_s >= begin) & (day.time_s <= end)
    torque.plot(day.t[shown][::2], day.tau[shown, JOINT][::2], color="#9aa1a9", lw=0.8, label="logged torque, 1 kHz")
    torque.plot(day.time_s[at], day.torque[at, JOINT], ".", color=BLUE, ms=5, label="rows: smoothed torque")
    torque.plot(day.time_s[at], day.predicted(theta)[at, JOINT], color=ORANGE, lw=1.2, label="prediction of the balance")
    torque.set_ylabel("torque of joint 2, N m")
    torque.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncol=3, frameon=False, fontsize=9, borderaxespad=0.2)
    std = noise[JOINT][0]
    left.axhspan(-2 * std, 2 * std, color="#dcebf5", lw=0)
    left.plot(day.time_s[at], day.left(theta)[at, JOINT], ".-", color=BLUE, ms=4, lw=0.7)
    left.text(end, -2.2 * std, "± 2 standard deviations ", ha="right", va="top", fontsize=9, color=GREY)
    left.set(ylabel="residual, N m", xlabel="time, s", xlim=(begin, end), ylim=(-5 * std, 5 * std))
    figure.align_ylabels()
    save(figure, folder, "rows", "Torque of joint 2 of a healthy log, its rows, and what the torque balance predicts")


def draw_days(days, names, theta, noise, rms, folder):
    estimates = []
    for day in days:
        columns, std = day_columns(day, theta, rms)
        white = whitener(day, theta, noise)
        left = white([day.left(theta)[:, [j]] for j in range(3)])[:, 0]
        value, covariance, _ = regress(white(columns), left, std**-2.0)
        estimates.append((value, np.sqrt(np.diag(covariance)), std))
    figure, axes = new_axes(3.5, (1, 3), gridspec_kw={
        "left": 0.075, "right": 0.985, "top": 0.8, "bottom": 0.145, "wspace": 0.42, "width_ratios": [3, 2, 2]})
    for axis, (title, first, count, scale, unit) in zip(axes, [("friction", 4, 3, 100, "%"), ("gain of the torque", 7, 2, 100, "%"),
                                                             ("offset of the torque", 9, 2, 1000, "mN m")]):
        for j in range(count):
            prior = scale * estimates[0][2][first + j]
            axis.add_patch(plt.Rectangle((j - 0.38, -prior), 0.76, 2 * prior, color="#e6e8ea", lw=0,
                                         label="prior of a day" if j == 0 else None))
            for d, colour in enumerate([BLUE, GREEN, PURPLE, ORANGE][:len(days)]):
                value, std, _ = (scale * each[first + j] for each in estimates[d])
                axis.errorbar(j - 0.24 + 0.16 * d, value, std, fmt="o", color=colour, ms=4, capsize=2.5, lw=1.2,
                              label=names[d] if j == 0 else None)
        axis.axhline(0, color="#666666", lw=0.7)
        axis.set(title=title, ylabel=unit, xticks=range(count), xlabel="joint", xlim=(-0.6, count - 0.4))
        axis.set_xticklabels([str(j + 1) for j in range(count)])
        axis.grid(axis="x", visible=False)
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper left", bbox_to_anchor=(0.06, 1.0), ncol=4, frameon=False, fontsize=9)
    save(figure, folder, "days", "Estimated effects of each day with their standard errors")
    return estimates


def hypotheses(rows, theta, rms):
    """Name, colour, columns by joint and prior standard deviations of some faults, as if they lasted all the time."""
    def at_joint(j, columns):
        return [columns if i == j else np.zeros_like(columns) for i in range(3)]
    friction = lambda j: at_joint(j, rows.column[j][:, [4 + j, 7 + j]])  # noqa: E731
    payload = [rows.column[j][:, :4] @ np.array([[0.4**2], [0.3**2], [0.4 * 0.3], [1.0]]) for j in range(3)]
    return [("friction, joint 2", BLUE, friction(1), 3 * theta[[5, 8]]),
            ("lost torque, joint 2", ORANGE, at_joint(1, rows.torque[:, [1]]), np.array([0.5])),
            ("torque sensor, joint 2", GREEN, at_joint(1, np.ones((len(rows.time_s), 1))), np.array([0.6 * rms[1]])),
            ("friction, joint 1", PURPLE, friction(0), 3 * theta[[4, 7]]),
            ("payload at the tip", GREY, payload, np.array([0.6 * theta[3]]))]


def draw_scores(rows, theta, noise, rms, folder):
    white = whitener(rows, theta, noise)
    columns, day_std = day_columns(rows, theta, rms)
    effects, left = white(columns), white([rows.left(theta)[:, [j]] for j in range(3)])[:, 0]
    _, _, healthy = regress(effects, left, day_std**-2.0)
    onsets = np.arange(rows.time_s[20], rows.time_s[-2], ROW_SAMPLES / 2000)
    figure, axis = new_axes(3.9, (1, 1), gridspec_kw={"left": 0.095, "right": 0.985, "top": 0.93, "bottom": 0.125})
    print(f"evidence of {FAULTY}, true onset {ONSET_S} s")
    for name, colour, fault, std in hypotheses(rows, theta, rms):
        nats = []
        for onset in onsets:
            step = soft_step(rows, onset)[:, None]
            both = np.hstack([effects, white([step * part for part in fault])])
            nats.append(regress(both, left, np.concatenate([day_std, std]) ** -2.0)[2] - healthy)
        axis.plot(onsets, np.array(nats) / 1000, color=colour, lw=1.6, label=name)
        best = int(np.argmax(nats))
        print(f"  {name}: {nats[best]:.0f} nats at {onsets[best]:.3f} s")
    axis.axvline(ONSET_S, color="#333333", lw=1, ls=":")
    axis.text(ONSET_S, 1.01, "true onset", ha="center", va="bottom", fontsize=9, transform=axis.get_xaxis_transform())
    axis.set(xlabel="onset of the hypothesis, s", ylabel="evidence, 1000 nats", xlim=(onsets[0], onsets[-1]))
    axis.legend(loc="upper right", frameon=True, framealpha=1, edgecolor="none", fontsize=9)
    save(figure, folder, "scores", "Evidence of five hypotheses over their onset")


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/pictures"
    days = [Rows(name) for name in HEALTHY]
    rms = np.sqrt(np.mean(np.concatenate([day.torque for day in days]) ** 2, 0))
    scale = [np.ones(3)]
    for _ in range(3):  # each joint by its own residual
        stacked = np.vstack([day.column[j] / scale[-1][j] for day in days for j in range(3)])
        torque = np.concatenate([day.torque[:, j] / scale[-1][j] for day in days for j in range(3)])
        theta = np.linalg.lstsq(stacked, torque, rcond=None)[0]
        scale.append(np.sqrt(np.mean(np.concatenate([day.left(theta) for day in days]) ** 2, 0)))
    noise = noise_of(days, theta)
    print("a, b, c, m3, viscous, Coulomb:", np.array2string(theta, precision=4))
    print("residual rms:", np.array2string(scale[-1], precision=4))
    draw_rows(days[0], theta, noise, folder)
    for value, std, _ in draw_days(days, HEALTHY, theta, noise, rms, folder):
        print("effects of a day:", np.array2string(value[4:], precision=5), "+-", np.array2string(std[4:], precision=5))
    draw_scores(Rows(FAULTY), theta, noise, rms, folder)


if __name__ == "__main__":
    main()
