# SPDX-License-Identifier: MIT
"""The measurements of python_speed.sh: python_speed.py PROGRAM PAIRS FOLDER"""
import os
import pathlib
import resource
import statistics
import subprocess
import sys

import faultline

GOLDEN = pathlib.Path("sample_logs/golden")
MODEL = next(GOLDEN.glob("model-*.json"))
CASES = next(GOLDEN.glob("cases-*.db"))
ROWS = 600_000
PERIOD_S = 0.073  # of the model
MOST = 1.1


def long_run(program, folder):
    """A healthy run of the golden model's robot, simulated."""
    spec = pathlib.Path("sample_logs/bench/spec.toml").read_text()
    robot = spec[: spec.index("[[run]]")].replace('format = "csv"', 'format = "flog"')
    (folder / "spec.toml").write_text(f'{robot}[[run]]\nname = "run"\nduration_s = {PERIOD_S * (ROWS - 1)}\n')
    subprocess.run([program, "simulate", folder / "spec.toml", "-o", folder], stdout=subprocess.DEVNULL, check=True)
    return faultline.open_log(folder / "run.flog").to_dict()


def user_seconds(who):
    return resource.getrusage(who).ru_utime


def of_program(program, log):
    before = user_seconds(resource.RUSAGE_CHILDREN)
    arguments = [program, "diagnose", log, "--model", MODEL, "--cases", CASES, "--json", os.devnull]
    subprocess.run(arguments, stdout=subprocess.DEVNULL, check=False)
    return user_seconds(resource.RUSAGE_CHILDREN) - before


def of_module(columns):
    before = user_seconds(resource.RUSAGE_SELF)
    faultline.diagnose(columns, MODEL, cases=CASES).to_json()
    return user_seconds(resource.RUSAGE_SELF) - before


def import_seconds(modules):
    code = f"import time; a = time.perf_counter(); import {modules}; print(time.perf_counter() - a)"
    return min(
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)
        for _ in range(7)
    )


def main(program, pairs, folder):
    for modules in ("faultline", "numpy, faultline", "numpy"):
        print(f"import {modules}: {import_seconds(modules):.3f} s")
    columns = long_run(program, folder)
    logs = {"csv": folder / "run.csv", "flog": folder / "run.flog"}
    subprocess.run([program, "convert", logs["flog"], logs["csv"]], stdout=subprocess.DEVNULL, check=True)
    worst = 0.0
    for kind, log in logs.items():
        ratios, mine, theirs = [], [], []
        for _ in range(pairs):
            theirs.append(of_program(program, log))
            mine.append(of_module(columns))
            ratios.append(mine[-1] / theirs[-1])
        ratio = statistics.median(ratios)
        worst = max(worst, ratio)
        print(
            f"{ROWS} rows: a frame {statistics.median(mine):.2f} s, the program on .{kind}"
            f" {statistics.median(theirs):.2f} s of processor time; ratio {ratio:.3f}"
        )
    print(f"largest ratio {worst:.3f}, at most {MOST} is promised")
    return worst > MOST


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2]), pathlib.Path(sys.argv[3])))
