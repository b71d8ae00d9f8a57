#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Damaged files: single bits flipped and ends cut off, in each kind of file that the program reads.

Usage: damage.py FAULTLINE OUT [COUNT] [SEED] [KIND...]
OUT/bench.json is a model of sample_logs/bench. Prints a table; each finding stands below it, its file is in
OUT/findings. A legal file is one that somebody could have written so: other digits in a number of a text
file, a text cut at the end of a line.
"""
import collections
import csv
import dataclasses
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tomllib
from typing import Callable

PATIENCE_S = 20  # of processor time
CLASSES = ["refused", "told", "harmless", "legal", "SILENT", "UNCLEAR", "CRASH", "HANG"]
FINDINGS = CLASSES[4:]
NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*", re.ASCII)
SLIDE = """robot = "P"
motion = {profile = "quintic", low = [-0.5], high = [0.5]}
duration_s = 30.0
sample_period_s = 0.02
[[run]]
name = "healthy"
[[run]]
name = "faulty"
fault = {kind = "torque_loss", joint = 1, onset_s = 12.0, size = 0.5}
"""
IDENTIFIED_SPEC = """robot = "identified.toml"
duration_s = 4.0
sample_period_s = 0.02
[[run]]
name = "run"
"""
MAKE = """simulate slide.toml -o .
convert log.csv log.flog
convert cut.csv lost.csv
convert cut.csv lost.flog
identify small.csv --robot robot.toml -o identified.toml
cases export --model bench.json -o cases.json
diagnose fault.csv --model bench.json --json report.json
golden record small.csv fault.csv --model bench.json -o golden
golden check golden --json check.json
golden check golden --json check2.json
batch fault.csv --model bench.json -o batch"""


def shape(value):
    if isinstance(value, dict):
        return {key: shape(one) for key, one in value.items()}
    if isinstance(value, list):
        return [shape(one) for one in value]
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return "number" if number or value is None else type(value).__name__


def at_line_end(before, after):
    return after.endswith(b"\n") or before[len(after):len(after) + 1] == b"\n"


def legal_toml(before, after, is_cut):
    try:
        there, now = tomllib.loads(before.decode()), tomllib.loads(after.decode())
    except (UnicodeDecodeError, tomllib.TOMLDecodeError):
        return False
    return at_line_end(before, after) if is_cut else shape(there) == shape(now)


def legal_json(before, after, is_cut):
    try:
        return not is_cut and shape(json.loads(before)) == shape(json.loads(after))
    except ValueError:
        return False


def table(text):
    """The header and the rows, comments apart; each cell as its text where it is no number."""
    lines = text.decode("latin-1").split("\n")
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if line and not line.startswith("#")))
    return comments, rows[:1], [["" if NUMBER.fullmatch(cell) else cell for cell in row] for row in rows[1:]]


def legal_csv(before, after, is_cut):
    if is_cut:
        return at_line_end(before, after) and b"\n" in after
    try:
        return table(before) == table(after)
    except csv.Error:
        return False


@dataclasses.dataclass
class Kind:
    """A file, and the commands that read it."""
    name: str
    file: str
    lines: str
    outputs: str = ""
    legal: Callable = lambda *_: False
    share: int = 1        # of COUNT, one in so many
    fresh: bool = False   # the commands change more than their outputs

    def commands(self):
        return [line.split() for line in self.lines.split("; ")]


def kinds():
    def log(name, file, legal=None, share=1):
        return Kind(name, file, f"convert {file} -; inspect {file} --json -", "", legal or Kind.legal, share)

    identify = "identify small.csv --robot {} -o - --json result.json"
    export = "cases export --cases bench.json.cases.db"
    check = "golden check golden --json -"
    batch = "batch fault.csv --model bench.json -o batch --json -"
    made = "batch/index.csv batch/index.ndjson batch/logs batch/summary.json"
    return [
        log("CSV log", "log.csv", legal_csv),
        log("CSV log that tells its losses", "lost.csv", legal_csv),
        log("native log", "log.flog"),
        log("long native log", "long.flog", share=2),
        log("native log that tells its losses", "lost.flog"),
        Kind("robot", "robot.toml", identify.format("robot.toml"), "result.json", legal_toml, 2),
        Kind("identified robot", "identified.toml", "simulate spec.toml -o simulated; " + identify.format(
            "identified.toml"), "result.json simulated", legal_toml, 2, True),
        Kind("simulation spec", "simulation.toml", "simulate simulation.toml -o simulated", "simulated",
             legal_toml, 2, True),
        Kind("labels", "labels.csv", "learn healthy.csv faulty.csv --robot P --labels labels.csv "
             "-o slide.json --runs-per-label 4 --json -", "slide.json", legal_csv, 16, True),
        Kind("model", "bench.json", "diagnose fault.csv --model bench.json --json -"),
        Kind("case base", "bench.json.cases.db", export),
        Kind("cases export", "cases.json", "cases import cases.json --cases imported.db --replace; "
             "cases export --cases imported.db", "", legal_json, 2),
        Kind("diagnosis report", "report.json", "cases add report.json --cases bench.json.cases.db; "
             + export, "", legal_json, 2, True),
        Kind("golden.toml", "golden/golden.toml", check, "", legal_toml, 2),
        Kind("golden trace", "golden/traces", check, share=2),
        Kind("golden check", "check2.json", "golden compare golden check.json check2.json --json -", "",
             legal_json),
        Kind("batch journal", "batch/.batch/journal", batch, made, Kind.legal, 5, True),
        Kind("batch finished.json", "batch/.batch/finished.json", batch, made, Kind.legal, 5, True),
        Kind("batch result", "batch/logs", batch, made, Kind.legal, 5, True)]


def bytes_of(path):
    if os.path.isdir(path):
        return b"".join(name.encode() + bytes_of(f"{path}/{name}") for name in sorted(os.listdir(path)))
    with open(path, "rb") as file:
        return file.read()


def write(path, content):
    with open(path, "wb") as file:
        file.write(content)


def make_world(faultline, out, world):
    """The folder with the undamaged files, made by the program."""
    shutil.rmtree(world, ignore_errors=True)
    os.makedirs(world)
    for path, name in {"sample_logs/golden/logs/healthy_trapezoidal.csv": "small.csv",
                       "sample_logs/golden/logs/locked_1.csv": "fault.csv",
                       "sample_logs/industrial/locked_2.flog": "long.flog",
                       "sample_logs/bench/robot.toml": "robot.toml",
                       "sample_logs/golden/spec.toml": "simulation.toml",
                       f"{out}/bench.json": "bench.json",
                       f"{out}/bench.json.cases.db": "bench.json.cases.db"}.items():
        shutil.copy(path, f"{world}/{name}")
    fault = bytes_of(f"{world}/fault.csv")
    for name, content in {"log.csv": fault, "cut.csv": fault[:20000], "spec.toml": IDENTIFIED_SPEC.encode(),
                          "slide.toml": SLIDE.encode()}.items():
        write(f"{world}/{name}", content)
    for line in MAKE.split("\n"):
        done = subprocess.run([faultline, *line.split()], cwd=world, capture_output=True)
        if done.returncode > 1:
            sys.exit(f"{line}: {done.stderr.decode()}")


@dataclasses.dataclass
class Result:
    status: int
    said: str      # of the command that ended it
    lines: set     # of what was said on the way
    bytes: bytes   # all that was made, hashes of inputs apart

    def codes(self):
        return collections.Counter(re.findall(rb'"code": ?"(\w+)"', self.bytes))


def run(faultline, kind, place):
    """All commands of the kind, until one refuses."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (PATIENCE_S, PATIENCE_S + 1))
    result = Result(0, "", set(), b"")
    for arguments in kind.commands():
        done = subprocess.run([faultline, *arguments], cwd=place, capture_output=True, preexec_fn=limit)
        result.said = done.stderr.decode(errors="replace")
        result.lines |= set(result.said.split("\n"))
        result.bytes += done.stdout
        result.status = max(result.status, done.returncode)
        if done.returncode not in (0, 1):
            return dataclasses.replace(result, status=done.returncode)
    result.bytes = re.sub(rb"[0-9a-f]{64}", b"HASH", result.bytes + b"".join(
        bytes_of(f"{place}/{output}") for output in kind.outputs.split()
        if os.path.exists(f"{place}/{output}")))
    return result


def class_of(kind, intact, result, before, after, is_cut):
    if result.status == -signal.SIGXCPU:
        return "HANG"
    if result.status < 0 or result.status > 3 or "Sanitizer" in result.said:
        return "CRASH"
    if result.status > 1:
        said = result.said.encode() + result.bytes
        return "refused" if os.path.basename(kind.file)[:4].encode() in said else "UNCLEAR"
    if result.bytes == intact.bytes and result.status == intact.status:
        return "harmless"
    if result.status > intact.status or result.lines - intact.lines or result.codes() - intact.codes():
        return "told"
    return "legal" if kind.legal(before, after, is_cut) else "SILENT"


def damaged(before, is_cut, generator):
    """The damaged bytes, and what was done."""
    if is_cut:
        length = generator.randrange(len(before))
        return before[:length], f"cut to {length} of {len(before)} bytes, behind {before[:length][-24:]!r}"
    at, bit = generator.randrange(len(before)), generator.randrange(8)
    after = before[:at] + bytes([before[at] ^ 1 << bit]) + before[at + 1:]
    part = slice(max(0, at - 16), at + 16)
    return after, f"bit {bit} of byte {at}: {before[part]!r} to {after[part]!r}"


def difference(a, b):
    for one, other in zip(a.split(b"\n"), b.split(b"\n")):
        if one != other:
            return f"{one[:160]!r} became {other[:160]!r}"
    return f"{len(a)} bytes became {len(b)}"


class Bench:
    def __init__(self, faultline, out, count, seed):
        self.faultline, self.count, self.seed, self.notes = os.path.abspath(faultline), count, seed, []
        self.world, self.place, self.kept = f"{out}/world", f"{out}/work", f"{out}/findings"
        os.makedirs(self.kept, exist_ok=True)
        make_world(self.faultline, out, self.world)

    def fill(self):
        shutil.rmtree(self.place, ignore_errors=True)
        shutil.copytree(self.world, self.place)

    def one(self, kind, intact, before, how, i):
        after, what = damaged(before, how == "cut", random.Random(f"{self.seed} {kind.name} {how} {i}"))
        if kind.fresh:
            self.fill()
        write(f"{self.place}/{kind.file}", after)
        result = run(self.faultline, kind, self.place)
        found = class_of(kind, intact, result, before, after, how == "cut")
        why = result.said.strip()[:300] or difference(intact.bytes, result.bytes)
        if found in FINDINGS:
            name = f"{kind.name.replace(' ', '_')}-{how}-{i}"
            self.notes.append(f"{found}: {name}: {what}\n    {why}")
            write(f"{self.kept}/{name}", after)
        return found

    def all_of(self, kind):
        self.fill()
        if os.path.isdir(f"{self.place}/{kind.file}"):  # a name that holds a part of a hash
            kind.file += "/" + sorted(os.listdir(f"{self.place}/{kind.file}"))[0]
        before = bytes_of(f"{self.place}/{kind.file}")
        intact = run(self.faultline, kind, self.place)
        for how in ("flip", "cut"):
            count = max(1, self.count // kind.share)
            found = collections.Counter(self.one(kind, intact, before, how, i) for i in range(count))
            print(f"| {kind.name} | {how} | {count} |", *(f"{found[c]} |" for c in CLASSES), flush=True)


def main(faultline, out, count=500, seed=1, *names):
    bench = Bench(faultline, out, int(count), int(seed))
    print("| file | damage | times | " + " | ".join(CLASSES) + " |\n|" + "---|" * (3 + len(CLASSES)))
    for kind in kinds():
        if not names or kind.name in names:
            bench.all_of(kind)
    print("\n" + "\n".join(bench.notes))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
