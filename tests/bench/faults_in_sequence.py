#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Grave faults after other faults, faults that come twice or are gone for a while, two at once.

Simulates, learns, diagnoses, prints.

Usage: faults_in_sequence.py     called by faults_in_sequence.sh
"""
import os
import sys

import healthy_but_different as base

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "faults-in-sequence")
FIRST_S, SECOND_S, LENGTH_S = 2.2137, 6.1071, 1.5
DURATION_S = 10.0

# what is wrong first (kind, joint, size and more), then the grave fault
PAIRS = [
    (("friction_increase", 1, 5.0, "viscous = 1.5"), ("free_swinging", 2)),
    (("friction_increase", 2, 3.0, "viscous = 1.5"), ("locked", 1)),
    (("friction_increase", 3, 9.0, "viscous = 1.5"), ("free_swinging", 1)),
    (("torque_loss", 1, 0.4, ""), ("locked", 2)),
    (("torque_loss", 2, 0.5, ""), ("free_swinging", 1)),
    (("torque_loss", 3, 0.2, ""), ("stuck_encoder", 1)),
    (("sensor_bias", 2, 0.03, ""), ("locked", 1)),
    (("sensor_bias", 3, 0.006, ""), ("free_swinging", 2)),
    (("sensor_drift", 2, 0.03, ""), ("free_swinging", 1)),
    (("payload_change", 3, 1.0, ""), ("free_swinging", 2)),
    (("payload_change", 3, 1.0, ""), ("locked", 1)),
    (("stuck_encoder", 3, 0.0, ""), ("free_swinging", 1)),
    (("locked", 3, 0.0, ""), ("free_swinging", 1)),
    (("collision", 1, 40.0, "duration_s = 0.05"), ("locked", 2)),
    (("collision", 2, 25.0, "duration_s = 0.05"), ("free_swinging", 1)),
    (("free_swinging", 3, 0.0, ""), ("locked", 2)),
]
TWICE = [("torque_loss", 1, 0.5), ("friction_increase", 2, 4.0), ("sensor_bias", 1, 0.03)]
LOOSE = [
    ("torque_loss", 1, 0.5, ""), ("torque_loss", 2, 0.4, ""), ("torque_loss", 3, 0.3, ""),
    ("friction_increase", 1, 5.0, "viscous = 1.5"), ("friction_increase", 2, 4.0, "viscous = 1.5"),
    ("sensor_bias", 1, 0.03, ""), ("sensor_bias", 2, 0.03, ""), ("free_swinging", 2, 0.0, ""),
]
GONE_FROM_S, GONE_S = 4.2137, 2.0
AT_ONCE = [
    (("torque_loss", 3, 0.3, ""), ("locked", 1, 0.0, "")),
    (("sensor_bias", 3, 0.006, ""), ("free_swinging", 2, 0.0, "")),
    (("torque_loss", 2, 0.4, ""), ("friction_increase", 1, 5.0, "viscous = 1.5")),
    (("payload_change", 3, 1.0, ""), ("friction_increase", 1, 5.0, "viscous = 1.5")),
    (("torque_loss", 2, 0.4, ""), ("sensor_drift", 1, 0.05, "")),
    (("torque_loss", 1, 0.4, ""), ("torque_loss", 2, 0.5, "")),
    (("sensor_bias", 2, 0.03, ""), ("friction_increase", 3, 9.0, "viscous = 1.5")),
    (("friction_increase", 1, 5.0, "viscous = 1.5"), ("friction_increase", 2, 3.0, "viscous = 1.5")),
    (("torque_loss", 1, 0.4, ""), ("stuck_encoder", 3, 0.0, "")),
    (("torque_loss", 2, 0.5, ""), ("locked", 3, 0.0, "")),
    (("friction_increase", 1, 5.0, "viscous = 1.5"), ("free_swinging", 2, 0.0, "")),
    (("payload_change", 3, 1.0, ""), ("torque_loss", 1, 0.4, "")),
]


def event(kind, joint, onset_s, size=0.0, more=""):
    text = f'[[run.fault]]\nkind = "{kind}"\njoint = {joint}\nonset_s = {onset_s}\n'
    if size:
        text += f"size = {size}\n"
    return text + more + "\n"


def cases():
    """(name, what is to be listed as (kind, joint, onset, end), the spec's text)"""
    out = []
    for i, ((kind, joint, size, more), (grave, at)) in enumerate(PAIRS):
        text = event(kind, joint, FIRST_S, size, more) + event(grave, at, SECOND_S)
        out.append((f"pair_{i + 1}", [(kind, joint, FIRST_S, None), (grave, at, SECOND_S, None)], text))
    for i, (kind, joint, size) in enumerate(TWICE):
        length = f"duration_s = {LENGTH_S}"
        text = event(kind, joint, FIRST_S, size, length) + event(kind, joint, SECOND_S, size, length)
        expected = [(kind, joint, at, at + LENGTH_S) for at in (FIRST_S, SECOND_S)]
        out.append((f"twice_{i + 1}", expected, text))
    for i, pair in enumerate(AT_ONCE):
        text = "".join(event(kind, joint, SECOND_S, size, more) for kind, joint, size, more in pair)
        out.append((f"at_once_{i + 1}", [(kind, joint, SECOND_S, None) for kind, joint, _, _ in pair], text))
    for i, (kind, joint, size, more) in enumerate(LOOSE):
        length, again_s = f"duration_s = {GONE_FROM_S - FIRST_S}\n", GONE_FROM_S + GONE_S
        text = event(kind, joint, FIRST_S, size, length + more) + event(kind, joint, again_s, size, more)
        out.append((f"loose_{i + 1}", [(kind, joint, FIRST_S, GONE_FROM_S), (kind, joint, again_s, None)], text))
    return out


def listed(expected, faults):
    """Whether a finding has that kind and joint, begins near it and, where it ends, ends near it."""
    kind, joint, onset_s, end_s = expected
    return any(f["kind"] == kind and f["joint"] == joint and
               abs(f["onset_s"] - onset_s) < 0.5 and (end_s is None or abs(f["end_s"] - end_s) < 0.5)
               for f in faults)


def main():
    base.OUT, base.DURATION_S = OUT, DURATION_S
    model, seconds = base.learn()
    print(f"learned in {seconds:.0f} s", file=sys.stderr)
    print("| case | faults | all listed | more than those | reported |\n|---|---|---|---|---|")
    totals = {}
    folder = os.path.join(OUT, "runs")
    base.simulate(folder, base.Row(), 500, [((name, "", 0), text) for name, _, text in cases()])
    reports = base.diagnose_all([os.path.join(folder, name + ".csv") for name, _, _ in cases()], model)
    for (name, expected, _), report in zip(cases(), reports):
        faults = report["faults"]
        right, extra = all(listed(e, faults) for e in expected), max(0, len(faults) - len(expected))
        what = ", ".join(f"{kind} {joint}" for kind, joint, _, _ in expected)
        said = ", ".join(f"{f['kind']} {f['joint']} {f['onset_s']:.2f} to {f['end_s']:.2f}" for f in faults)
        print(f"| {name} | {what} | {'yes' if right else 'no'} | {extra} | {said} |", flush=True)
        group = totals.setdefault(name.rsplit("_", 1)[0], [0, 0, 0])
        totals[name.rsplit("_", 1)[0]] = [group[0] + right, group[1] + 1, group[2] + extra]
    for group, (right, count, extra) in totals.items():
        print(f"{group}: all listed in {right} of {count}, {extra} findings more")


if __name__ == "__main__":
    main()
