#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the program and its peers by the figures that the field uses: AUROC, delay, false alarms an hour.

Usage: field.py DATA [GROUP...]     called by field.sh; a group is the begin of its name, such as "living" or "doosan"

All learn from the same healthy logs and judge the same rows. An alarm is right if it begins while the event lasts;
every other one is false. Hard events are the half of each group with the larger size: the torque of a simulated
contact, else the largest residual of the momentum observer, in units of its limit, in the first second of the event.
"""
import copy
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

import field_logs
import field_peers

FAULTLINE = os.environ["FAULTLINE"]
OUT = pathlib.Path(os.environ["FAULTLINE_OUT"]) / "field"
KEEP = os.environ.get("KEEP") == "1"
NUMBERS = [int(n) for n in os.environ.get("NUMBERS", "").split()]  # of healthy logs; none: those of each group
JOINED_S = 0.5  # alarms of a peer that follow each other so closely are one
LEAD_S = 0.5  # at the start of a log, in which the program searches no onset, and no peer is judged
BEFORE_S, AFTER_S = 0.25, 0.1  # of a labelled collision: labels are exact to .2 s
FIRST_S = 1.0  # of an event, for its size
NEVER = field_logs.NEVER


class Alarm:
    def __init__(self, begin, end, label=None, others=()):
        self.begin, self.end, self.label, self.others = begin, end, label, others


class Judged:
    """What one method gives one log."""

    def __init__(self, alarms, score=float("nan"), rows=None, verdict="", reason=""):
        self.alarms, self.score, self.rows, self.verdict, self.reason = alarms, score, rows, verdict, reason


# --- the program ---

def run(command, log):
    begin = time.monotonic()
    with open(log, "w", encoding="utf-8") as out:
        status = subprocess.run([FAULTLINE, *map(str, command)], stdout=out, stderr=out, check=False).returncode
    return status, time.monotonic() - begin


def learned(group, logs, folder):
    """Learns a model and identifies the robot; returns (whether there is a model, the sentence of a refusal, s)."""
    folder.mkdir(parents=True, exist_ok=True)
    status_file, model = folder / "learn_status", folder / "model.json"
    (folder / "robot.toml").write_text(group.robot, encoding="utf-8")
    paths = [log.path for log in logs]
    if not (KEEP and status_file.exists()):
        model.unlink(missing_ok=True)
        status, seconds = run(["learn", *paths, "--robot", folder / "robot.toml", "-o", model], folder / "learn.txt")
        (folder / "learn_s").write_text(f"{seconds:.1f}")
        status_file.write_text(str(status))
    if not (KEEP and (folder / "identify.txt").exists()):
        (folder / "identified.toml").unlink(missing_ok=True)
        run(["identify", *paths, "--robot", folder / "robot.toml", "-o", folder / "identified.toml"],
            folder / "identify.txt")
    seconds = float((folder / "learn_s").read_text())
    if model.exists():
        return True, "", seconds
    said = [line for line in (folder / "learn.txt").read_text(encoding="utf-8").splitlines() if "faultline:" in line]
    return False, said[-1] if said else f"exit status {status_file.read_text().strip()}", seconds


def diagnosed(log, folder, with_rows):
    report, recording = folder / f"{log.path.stem}.json", folder / f"{log.path.stem}.mcap"
    command = ["diagnose", log.path, "--model", folder / "model.json", "--json", report]
    report.unlink(missing_ok=True)
    run(command + (["--mcap", recording] if with_rows else []), folder / f"{log.path.stem}.txt")
    if not report.exists():
        return Judged([], verdict="unusable")
    d = json.loads(report.read_text(encoding="utf-8"))
    alarms = [Alarm(f["alarm_s"], f["end_s"] if f["end_s"] is not None else NEVER, (f["kind"], f["joint"] or 0),
                    [(o["kind"], o["joint"] or 0) for o in f["could_also_be"]]) for f in d["faults"]]
    score = d["score"]["ratio"] if d.get("score") else float("nan")
    rows = None
    if with_rows and recording.exists():
        rows = field_logs.torque_residuals(recording)
        recording.unlink()
    return Judged(alarms, score, rows, d["verdict"], d["verdict_reason"] or "")


def program(group, logs, folder):
    """Judges the test logs of a group; returns ({log: Judged} or None, remark)."""
    is_learned, refusal, seconds = learned(group, logs, folder)
    if not is_learned:
        return None, f"learn refuses after {seconds:.0f} s: {refusal}"
    by_row = group.by_row
    out = {id(log): diagnosed(log, folder, by_row) for log in group.test + group.beside}
    if by_row:
        usual = [diagnosed(log, folder, True).rows for log in logs]
        usual = np.concatenate([rows[1] for rows in usual if rows is not None and len(rows[0])] or [np.zeros((0, 1))])
        for log in group.test:
            rows = out[id(log)].rows
            if rows is not None and len(rows[0]) and len(usual):
                score = (np.abs(rows[1]) / np.sqrt(np.nanmean(usual ** 2, axis=0))).max(axis=1)
                score = np.interp(log.t, rows[0][~np.isnan(score)], score[~np.isnan(score)])
                out[id(log)].rows = field_peers.averaged(score, log)
            else:
                out[id(log)].rows = None
    return out, f"learned in {seconds:.0f} s"


# --- a peer ---

def alarms_of(score, log, limit):
    """Returns the alarms of the rows whose score exceeds the limit."""
    times = log.t[score > limit]
    if not len(times):
        return []
    is_apart = np.diff(times) > JOINED_S
    return [Alarm(*span) for span in zip(times[np.r_[True, is_apart]], times[np.r_[is_apart, True]])]


def scores_of(peer, log):
    score = peer.score(log)
    score[log.t < log.t[0] + LEAD_S] = 0.0
    return score


def judged_at(group, rows, limit):
    return {id(log): Judged(alarms_of(rows[id(log)], log, limit), rows[id(log)].max() / limit, rows[id(log)])
            for log in group.test}


# --- figures ---

class Figures:
    """Of one method on one group, or on several by added()."""

    def __init__(self, group, judged, with_ranks=True):
        self.events = self.right = self.named = self.false = 0
        self.scores, self.other_scores = [], []  # of logs
        self.found, self.delays, self.hours = [], [], 0.0
        for log in group.test:
            (self.take_fault if group.has_one_fault and log.events else self.take_events)(log, judged[id(log)])
        self.rows = float("nan")
        if not with_ranks:
            return
        for log in group.test:
            (self.scores if log.events else self.other_scores).append(judged[id(log)].score)
        rows = [(judged[id(log)].rows, log.is_busy()) for log in group.test]
        if group.by_row and all(r is not None for r, _ in rows):
            self.rows = auroc(np.concatenate([r[b] for r, b in rows]), np.concatenate([r[~b] for r, b in rows]))

    def take(self, event, alarms, begin):
        """The event is found if there is an alarm; the first one names it."""
        self.events += 1
        if not alarms:
            return
        self.found.append(event)
        self.delays.append(max(0.0, alarms[0].begin - begin))
        if event.joint:
            want = (event.kind, event.joint)
            is_right = alarms[0].label == want or (event.kind == "unknown" == (alarms[0].label or "?")[0])
            self.right += is_right
            self.named += is_right or want in alarms[0].others

    def take_fault(self, log, judged):
        event = log.events[0]
        early = [a for a in judged.alarms if a.begin < event.begin - 1e-9]
        self.false += len(early)
        self.hours += (event.begin - log.t[0]) / 3600
        self.take(event, [a for a in judged.alarms if a not in early], event.begin)

    def take_events(self, log, judged):
        left = list(judged.alarms)
        for event in log.events:
            hits = [a for a in left if event.begin - BEFORE_S <= a.begin <= event.end + AFTER_S]
            self.take(event, hits, event.begin)
            left = [a for a in left if a not in hits]
        self.false += len(left)
        self.hours += log.hours_without_event()

    def logs(self):
        return auroc(self.scores, self.other_scores)

    def found_of(self, events):
        return f"{sum(e in self.found for e in events)} of {len(events)}"

    def delay(self):
        if not self.delays:
            return "-"
        return f"{statistics.median(self.delays):.3f}, {np.quantile(self.delays, 0.95):.3f}"

    def false_alarms(self):
        return f"{self.false}: {self.false / self.hours:.0f}, {most_by_chance(self.false) / self.hours:.0f}"


def auroc(events, others):
    """Probability that a score of an event is above one of another row or log; ties count half."""
    a, b = np.sort(np.asarray(others, float)), np.asarray(events, float)
    if not len(a) or not len(b) or np.isnan(a).any() or np.isnan(b).any():
        return float("nan")
    return float((np.searchsorted(a, b, "left") + np.searchsorted(a, b, "right")).mean() / (2 * len(a)))


def most_by_chance(count):
    """Upper end of the one-sided 95 % interval of a Poisson mean, of which `count` were seen (exact)."""
    low, high = float(count), 3.0 * count + 10.0
    for _ in range(60):
        mean = 0.5 * (low + high)
        below = sum(math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(count + 1))
        low, high = (mean, high) if below > 0.05 else (low, mean)
    return high


def added(figures):
    """Returns the figures of several groups together; none of rows."""
    out = copy.copy(figures[0])
    for name, value in vars(out).items():
        for other in figures[1:]:
            value = value + getattr(other, name)
        setattr(out, name, value)
    return out


def at_equal_false_alarms(group, rows, most):
    """The most events that any limit of the peer finds with at most so many false alarms; chosen after the fact."""
    best = 0
    for limit in np.geomspace(0.05, 50, 121):
        figures = Figures(group, judged_at(group, rows, limit), with_ranks=False)
        if figures.false <= most:
            best = max(best, len(figures.found))
    return best


def text(number):
    return "-" if math.isnan(number) else f"{number:.3f}"


# --- tables ---

def sized(group, rows):
    """Returns (hard, soft) events. `rows`: scores of the momentum observer, or of another peer without it."""
    events = []
    for log in group.test:
        for event in log.events:
            first = (log.t >= event.begin) & (log.t <= min(event.end, event.begin + FIRST_S))
            size = event.strength if group.name == "constant speed" else rows[id(log)][first].max(initial=0.0)
            events.append((size, event))
    events.sort(key=lambda e: e[0])
    return [e for _, e in events[len(events) // 2:]], [e for _, e in events[:len(events) // 2]]


HEAD = ("| method | found | hard | soft | right, or named | false alarms: an hour, 95 % upper bound | "
        "delay/s: median, 95 % | AUROC of logs | of rows | found at equal false alarms |\n|---|---|---|---|---|---|---|"
        "---|---|---|")


def print_line(name, f, sizes, equal):
    """A line of the table. `equal`: found at equal false alarms; None for the program itself."""
    if f is None:
        print(f"| {name} | refused | | | | | | | | |")
        return
    hard, soft = sizes
    right = f"{f.right}, {f.named}" if equal is None and any(e.joint for e in hard) else "-"
    print(f"| {name} | {len(f.found)} of {f.events} | {f.found_of(hard)} | {f.found_of(soft)} | {right} | "
          f"{f.false_alarms()} | {f.delay()} | {text(f.logs())} | {text(f.rows)} | "
          f"{len(f.found) if equal is None else equal} |")


def judged_by_all(group, number):
    """Returns ({method: (figures, scores of its rows)}, remarks) with so many healthy logs. Refused: None as figures;
    the program has no scores there."""
    folder = OUT / group.name.replace(", ", "-").replace(" ", "-") / f"n{number}"
    logs = group.healthy[:number]
    judged, remark = program(group, logs, folder)
    remarks = [f"{number} healthy log{'s' if number > 1 else ''}: {remark}"]
    methods = {"faultline": (Figures(group, judged) if judged else None, None)}
    unsure = [log for log in group.test if judged and judged[id(log)].verdict not in ("healthy", "faulty")]
    if unsure:
        remarks.append(f"{len(unsure)} of {len(group.test)} logs without a verdict, such as {unsure[0].path.name}: "
                       f"{judged[id(unsure[0])].reason}")
    for log in group.beside if judged else []:
        j = judged[id(log)]
        remarks.append(f"{log.path.name}, healthy with another load: faultline {len(j.alarms)} findings, verdict "
                       f"{j.verdict}, score {text(j.score)}")
    identified = folder / "identified.toml"
    for name, peer in field_peers.peers(identified if identified.exists() else None, logs):
        rows = {id(log): scores_of(peer, log) for log in group.test}
        methods[name] = (Figures(group, judged_at(group, rows, 1.0)), rows)
        for log in group.beside:
            score = scores_of(peer, log)
            remarks.append(f"{log.path.name}, healthy with another load: {name} {len(alarms_of(score, log, 1.0))} alarms, "
                           f"{100 * (score > 1.0).mean():.0f} % of the rows")
    return methods, remarks


def print_group(group):
    """Prints the table of a group and the curve over the number of healthy logs; returns what added_lines() needs."""
    curve, remarks = [], []
    for number in [n for n in group.numbers if not NUMBERS or n in NUMBERS] or group.numbers[-1:]:
        methods, said = judged_by_all(group, number)
        curve.append((number, methods))
        remarks += said
    sizes = sized(group, next(rows for _, rows in methods.values() if rows is not None))
    most = methods["faultline"][0].false if methods["faultline"][0] else 0
    print(f"### {group.name}\n\n{HEAD}")
    equal = {}
    for name, (figures, rows) in methods.items():
        equal[name] = None if rows is None else at_equal_false_alarms(group, rows, most)
        print_line(name, figures, sizes, equal[name])
    print()
    if len(curve) > 1:
        print("Found, false alarms and AUROC of logs by the number of healthy logs:\n")
        print("| method | " + " | ".join(f"{n}" for n, _ in curve) + " |\n|---" + "|---" * len(curve) + "|")
        for name in methods:
            cells = [m.get(name, (None, None))[0] for _, m in curve]
            print(f"| {name} | " + " | ".join(
                f"{len(f.found)}, {f.false}, {text(f.logs())}" if f else "refused" for f in cells) + " |")
        print()
    print("\n".join(f"- {remark}" for remark in remarks) + "\n", flush=True)
    return {name: figures for name, (figures, _) in methods.items()}, sizes, equal


def print_together(name, printed):
    """Prints the groups of one kind together."""
    print(f"### {name}, together\n\n{HEAD}")
    sizes = [sum((p[1][k] for p in printed), []) for k in range(2)]
    for method in printed[0][0]:
        figures = [p[0].get(method) for p in printed]
        equal = [p[2].get(method) for p in printed]
        if all(figures):
            print_line(method, added(figures), sizes, None if None in equal else sum(equal))
    print(flush=True)


def main(data, wanted):
    if not field_peers.has_sklearn():
        print("scikit-learn is missing (Debian: python3-sklearn): IsolationForest and one-class SVM are left out.\n")
    kinds = {"living": lambda: field_logs.living(data), "doosan": lambda: field_logs.doosan(data),
             "constant speed": lambda: field_logs.constant_speed(OUT / "constant-speed" / "logs")}
    for kind, make in kinds.items():
        if wanted and not any(w.startswith(kind) or kind.startswith(w) for w in wanted):
            continue
        groups = [g for g in make() if not wanted or any(g.name.startswith(w) for w in wanted)]
        printed = [print_group(group) for group in groups]
        if kind == "living" and len(printed) > 1:
            print_together(kind, printed)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), sys.argv[2:])
