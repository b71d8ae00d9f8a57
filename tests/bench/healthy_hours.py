#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hours of a healthy robot whose days differ: false alarms, processor time and memory by sampling rate.

Usage: healthy_hours.py HOURS [RATE...]     called by healthy_hours.sh
"""
import json
import os
import random
import resource
import subprocess
import sys

import healthy_but_different as simulated

OUT = os.path.join(os.environ["FAULTLINE_OUT"], "healthy-hours")
RATES = ("1000", "500", "100")  # Hz, the controller as fast as the log
LEARN_DAYS = 6
LEARN_S = 10.0
LOG_S = 600.0


def day_spec(period_s, rng, seed):
    """A robot of another day: friction, torque constants, noise."""
    simulated.PERIOD_S = period_s
    row = simulated.Row(friction=rng.uniform(0.8, 1.25), noise=rng.uniform(0.8, 1.3))
    gains = [round(rng.uniform(-0.015, 0.015), 5) for _ in range(3)]
    spec = simulated.spec_text(row, seed).replace('format = "csv"', 'format = "flog"')
    return spec.replace("[limits]", f"[drives]\ngain = {gains}\n\n[limits]")


def simulate(folder, name, spec, keys):
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, name + ".toml")
    with open(path, "w") as file:
        file.write(f'{spec}\n[[run]]\nname = "{name}"\n{keys}\n')
    simulated.run("simulate", path, "-o", folder)
    return os.path.join(folder, name + ".flog")


def learn(folder, period_s, rng):
    logs = [simulate(folder, f"learn_{i}", day_spec(period_s, rng, 100 + i), f"duration_s = {LEARN_S}")
            for i in range(LEARN_DAYS)]
    return simulated.learn_from(logs, folder, held=True)[0]


def diagnose(log, model):
    """The findings, the verdict, and the processor time (s) it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = simulated.diagnose(log, model)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return report["faults"], report["verdict"], cpu_s


def healthy_hours(rate, hours, folder, model, rng):
    logs = [(f"healthy_{i}", day_spec(1.0 / rate, rng, 1000 + i)) for i in range(round(3600.0 * hours / LOG_S))]
    alarms = inconclusive = with_alarm = 0
    cpu_s, notes = 0.0, []
    for name, spec in logs:
        log = simulate(folder, name, spec, f"duration_s = {LOG_S}")
        faults, verdict, took_s = diagnose(log, model)
        os.remove(log)
        cpu_s += took_s
        alarms += len(faults)
        with_alarm += bool(faults)
        inconclusive += verdict == "inconclusive"
        if faults:
            notes.append(f"{rate} Hz/{name}: reported {simulated.said(faults)}")
    print(f"| {rate} | {hours:g} | {with_alarm} of {len(logs)} | {alarms} | {inconclusive} | {cpu_s / hours:.0f} |", flush=True)
    return notes


def one_hour(rate, folder, model, rng):
    """Wall time, processor time and peak memory of one log of an hour: healthy, and a fault from 10 s on."""
    fault = 'fault = {kind = "torque_loss", joint = 2, onset_s = 10.0, size = 0.5}'
    for name, keys in (("healthy", ""), ("a fault all the time", fault)):
        log = simulate(folder, name.replace(" ", "_"), day_spec(1.0 / rate, rng, 77), f"duration_s = 3600\n{keys}")
        measured = os.path.join(folder, "measured")
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "measured_run.py")
        subprocess.run([sys.executable, script, measured, simulated.FAULTLINE, "diagnose", log, "--model", model, "--json",
                        os.path.join(folder, "hour.json")], capture_output=True, check=False)
        os.remove(log)
        with open(measured) as file, open(os.path.join(folder, "hour.json")) as report:
            wall_s, cpu_s, memory = file.read().split()
            findings = len(json.load(report)["faults"])
        print(f"| {name} | {wall_s} | {cpu_s} | {memory} | {findings} |", flush=True)


def main(hours, wanted):
    unknown = [rate for rate in wanted if rate not in RATES]
    if unknown:
        sys.exit(f"healthy_hours: no rate {unknown[0]}; expected one of {', '.join(RATES)}")
    notes, models = [], {}
    print("| rate/Hz | hours | logs with alarm | findings | inconclusive | processor time/s an hour |")
    print("|---|---|---|---|---|---|")
    for rate in RATES:
        if wanted and rate not in wanted:
            continue
        rng, folder = random.Random(int(rate)), os.path.join(OUT, rate)
        models[rate] = learn(folder, 1.0 / int(rate), rng)
        notes += healthy_hours(int(rate), hours, folder, models[rate], rng)
    print("\n" + "\n".join(notes))
    if "1000" in models:
        print("\n| an hour at 1 kHz | wall/s | processor/s | peak memory/MB | findings |\n|---|---|---|---|---|")
        one_hour(1000, os.path.join(OUT, "1000"), models["1000"], random.Random(5))


if __name__ == "__main__":
    main(float(sys.argv[1]), sys.argv[2:])
