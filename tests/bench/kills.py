#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writing commands that are killed, run out of room, or may not write on: is all there that was, and no more?

Usage: kills.py FAULTLINE OUT [KILLS] [FULL] [FAILING] [SEED]
Each command starts in a folder with old results. Whatever stops it, each file is then the old or the new one
(a case base by its export), and after the same command has run again all is as after an undisturbed run.
Prints a table and each finding. The robot is a slide, so that learning takes seconds.
"""
import collections
import dataclasses
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

SPEC = """robot = "P"
motion = {profile = "quintic", low = [-0.5], high = [0.5]}
duration_s = 30.0
sample_period_s = 0.02
[[run]]
name = "healthy"
[[run]]
name = "other"
[[run]]
name = "faulty"
fault = {kind = "torque_loss", joint = 1, onset_s = 12.0, size = 0.5}
"""
TEMPORARY = re.compile(r"\.partial-[0-9a-f]|-(journal|wal|shm)$")
UNCOMPARED = re.compile(r"/\.batch/(journal|lock)$")
GROWING = re.compile(r"/r/index\.(csv|ndjson)$")  # of a batch that is not finished: what is done
SIGNALS = [signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
KEPT = "belt changed"  # of the case that a person told
PAGE = 4096


@dataclasses.dataclass
class Command:
    name: str
    files: list       # of the world, that it reads or changes
    line: str
    old: str = ""     # results that are there before, whatever is in them
    share: int = 4    # of the kills
    once: bool = False  # done twice it is something else


BASE = ["new.json", "new.json.cases.db"]
COMMANDS = [
    Command("inspect", ["faulty.csv"], "inspect faulty.csv --json r.json", "r.json"),
    Command("convert", ["faulty.csv"], "convert faulty.csv r.flog", "r.flog"),
    Command("simulate", ["spec.toml"], "simulate spec.toml -o r", "r/healthy.csv r/labels.csv"),
    Command("identify", ["healthy.csv"], "identify healthy.csv --robot P -o r.toml --json r.json "
            "--html r.html --pictures r --suggest s.toml", "r.toml r.html s.toml"),
    Command("learn", ["healthy.csv", "old.json", "old.json.cases.db"],
            "learn healthy.csv --robot P -o old.json --runs-per-label 4", share=1),
    Command("diagnose", [*BASE, "faulty.csv"], "diagnose faulty.csv --model new.json --json r.json "
            "--csv r.csv --html r.html --md r.md --junit r.xml", "r.json r.csv r.html r.md r.xml"),
    Command("batch", [*BASE, "runs"], "batch runs --model new.json -o r --html --json r.json", "r.json"),
    Command("cases add", [*BASE, "report.json"], "cases add report.json --model new.json --fault locked "
            "--joint 1", once=True),
    Command("cases confirm", BASE, "cases confirm 5 --model new.json --done greased"),
    Command("cases reject", BASE, "cases reject 7 --model new.json"),
    Command("cases export", BASE, "cases export --model new.json -o r.json", "r.json"),
    Command("cases import", [*BASE, "cases.json"], "cases import cases.json --model new.json --replace"),
    Command("cases import, merged", [*BASE, "cases.json"],
            "cases import cases.json --model new.json --merge"),
    Command("golden record", [*BASE, "healthy.csv", "faulty.csv"],
            "golden record healthy.csv faulty.csv --model new.json -o r", once=True),
    Command("golden accept", [*BASE, "golden"], "golden accept golden --all --model new.json"),
    Command("golden check", ["golden"], "golden check golden --json r.json --junit r.xml", "r.json"),
    Command("model sign", ["edited.json"], "model sign edited.json --why shift"),
]
TO_FULL = ["inspect faulty.csv --json /dev/full", "golden check golden --json /dev/full",
           "cases export --model new.json -o /dev/full",
           "diagnose faulty.csv --model new.json --html /dev/full",
           "identify healthy.csv --robot P -o /dev/full"]
TO_STDOUT = ["inspect faulty.csv", "cases list --model new.json", "diagnose faulty.csv --model new.json",
             "convert faulty.csv -"]


def make_world(call, world):
    """What the commands read, once for all."""
    os.makedirs(f"{world}/runs", exist_ok=True)
    with open(f"{world}/spec.toml", "w") as file:
        file.write(SPEC)
    call(world, "simulate spec.toml -o .")
    for name, log in (("old", "other"), ("new", "healthy")):
        call(world, f"learn {log}.csv --robot P -o {name}.json --runs-per-label 4")
        call(world, f"cases add --fault locked --joint 1 --model {name}.json", "--done", KEPT)
    call(world, "diagnose faulty.csv --model new.json --json report.json")
    call(world, "golden record healthy.csv faulty.csv --model old.json -o golden")
    shutil.copy(f"{world}/new.json.cases.db", f"{world}/more.db")
    call(world, "cases add --cases more.db --fault free_swinging --joint 1")
    call(world, "cases export --cases more.db -o cases.json")
    for i in range(3):
        shutil.copy(f"{world}/faulty.csv", f"{world}/runs/{i}.csv")
    with open(f"{world}/new.json") as file, open(f"{world}/edited.json", "w") as edited:
        edited.write(re.sub(r'"name": "P"', '"name": "Q"', file.read(), count=1))
    os.mkdir(f"{world}/made")


def pages(sizes):
    return sum(1 + size // PAGE for size in sizes)


def sizes_below(path):
    return [os.path.getsize(f"{folder}/{name}") for folder, _, names in os.walk(path) for name in names]


class Bench:
    def __init__(self, faultline, out, seed):
        self.faultline, self.out, self.world = os.path.abspath(faultline), out, f"{out}/world"
        self.random, self.findings, self.wholes = random.Random(seed), [], {}
        self.place = f"{out}/place"
        if not os.path.exists(f"{self.world}/made"):
            make_world(self.call, self.world)

    def call(self, folder, arguments, *more):
        whole = [self.faultline, *arguments.split(), *more]
        done = subprocess.run(whole, cwd=folder, capture_output=True, text=True)
        if done.returncode > 1:
            sys.exit(f"{arguments}: {done.stderr}")

    def fill(self, command, place):
        for name in os.listdir(place) if os.path.isdir(place) else []:
            path = f"{place}/{name}"
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
        os.makedirs(place, exist_ok=True)
        for name in command.files:
            path = f"{self.world}/{name}"
            (shutil.copytree if os.path.isdir(path) else shutil.copy)(path, f"{place}/{name}")
        for name in command.old.split():
            os.makedirs(os.path.dirname(f"{place}/{name}"), exist_ok=True)
            with open(f"{place}/{name}", "w") as file:
                file.write("old")

    def content(self, path):
        """A case base as its export, or as why there is none."""
        if path.endswith(".db"):
            done = subprocess.run([self.faultline, "cases", "export", "--cases", path], capture_output=True)
            return done.stdout if done.returncode == 0 else done.stderr
        with open(path, "rb") as file:
            return file.read()

    def state(self, place):
        paths = (f"{folder}/{name}" for folder, _, names in os.walk(place) for name in sorted(names))
        return {path[len(place):]: b"" if TEMPORARY.search(path) else self.content(path)
                for path in paths if not UNCOMPARED.search(path)}

    def start(self, command, place, **more):
        return subprocess.Popen([self.faultline, *command.line.split()], cwd=place, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, **more)

    def whole(self, command):
        """State before, state after, exit status, seconds, of an undisturbed run."""
        if command.name not in self.wholes:
            self.fill(command, self.place)
            before, begin = self.state(self.place), time.monotonic()
            run = self.start(command, self.place)
            said = run.communicate()[1]
            seconds = time.monotonic() - begin
            if run.returncode > 1:
                sys.exit(f"{command.name}: {said}")
            self.wholes[command.name] = before, self.state(self.place), run.returncode, seconds
        return self.wholes[command.name]

    def note(self, command, what, message):
        self.findings.append(f"{command.name}, {what}: {message}")
        print(self.findings[-1], file=sys.stderr, flush=True)

    def check_stopped(self, command, what, place, tidy):
        """Each file is the old or the new one; none is missing. Gives what is there."""
        before, after = self.whole(command)[:2]
        now = self.state(place)
        left = [name for name in now if TEMPORARY.search(name)]
        if tidy and any(".partial-" in name for name in left):
            self.note(command, what, f"left {left}")
        for name in sorted(now.keys() - set(left)):
            if now[name] not in (before.get(name), after.get(name)) and not GROWING.search(name):
                self.note(command, what, f"{name} is neither old nor new: {now[name][:200]!r}")
            if KEPT.encode() in before.get(name, b"") and KEPT.encode() not in now[name]:
                self.note(command, what, f"{name} has lost the confirmed case")
        for name in sorted((before.keys() & after.keys()) - now.keys()):
            self.note(command, what, f"{name} is lost")
        return now

    def check_again(self, command, what, place, stopped):
        """The same command again: all is as undisturbed, and nothing is left."""
        after, status = self.whole(command)[1:3]
        run = self.start(command, place)
        said = run.communicate()[1]
        if command.once and after.items() <= stopped.items():  # it was done
            after, status = self.state(place), run.returncode
            after = {name: after[name] for name in after if not TEMPORARY.search(name)}
        now = self.state(place)
        if run.returncode != status:
            self.note(command, what, f"run again: status {run.returncode}, not {status}: {said}")
            now = after
        for name in sorted(name for name in now.keys() | after.keys() if now.get(name) != after.get(name)):
            how = "missing" if name not in now else "not as undisturbed" if name in after else "left"
            self.note(command, what, f"run again: {name} is {how}")

    def wait_for_writing(self, run):
        """Until a temporary file is there, or the end."""
        while run.poll() is None:
            if any(TEMPORARY.search(name) for _, _, names in os.walk(self.place) for name in names):
                time.sleep(self.random.uniform(0.0, 0.01))
                break
            time.sleep(0.0005)

    def kill(self, command, i):
        seconds = self.whole(command)[3]
        self.fill(command, self.place)
        number = self.random.choice(SIGNALS)
        run = self.start(command, self.place)
        self.wait_for_writing(run) if i % 2 else time.sleep(self.random.uniform(0.0, 1.05 * seconds))
        run.send_signal(number)
        run.communicate()
        what, killed = f"kill {i} ({number.name})", run.returncode < 0
        stopped = self.check_stopped(command, what, self.place, number != signal.SIGKILL)
        self.check_again(command, what, self.place, stopped)
        return killed, killed and any(TEMPORARY.search(name) for name in stopped)

    def fill_disk(self, command, i):
        place = os.path.abspath(f"{self.out}/full")
        os.makedirs(place, exist_ok=True)
        mount = ["mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", place]
        if subprocess.run(mount, capture_output=True).returncode != 0:
            return None
        try:
            before, after = self.whole(command)[:2]
            self.fill(command, place)
            more = pages(len(after[name]) for name in after if after[name] != before.get(name))
            size = PAGE * (pages(sizes_below(place)) + self.random.randrange(1, more + 1))
            subprocess.run(["mount", "-o", f"remount,size={size}", place], check=True)
            relieve = ["mount", "-o", "remount,size=64m", place]
            return self.stopped(command, f"full disk {i} of {size} bytes", place, relieve)
        finally:
            subprocess.run(["umount", place], check=True)

    def limit_size(self, command, i):
        largest = max([len(content) for content in self.whole(command)[1].values()])
        size = self.random.randrange(1, largest)
        self.fill(command, self.place)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        what = f"failing write {i}, behind {size} bytes"
        return self.stopped(command, what, self.place, ["true"], preexec_fn=limit)

    def stopped(self, command, what, place, relieve, **more):
        """Whether the command failed, as it must say."""
        run = self.start(command, place, **more)
        said = run.communicate()[1]
        failed = run.returncode != self.whole(command)[2]
        if failed and (run.returncode != 3 or not said):
            self.note(command, what, f"status {run.returncode}: {said.strip()}")
        there = self.check_stopped(command, what, place, True)
        subprocess.run(relieve, check=True)
        self.check_again(command, what, place, there)
        return failed

    def to_full_device(self):
        tries = [(line, os.devnull) for line in TO_FULL] + [(line, "/dev/full") for line in TO_STDOUT]
        for line, device in tries:
            with open(device, "w") as stdout:
                run = subprocess.run([self.faultline, *line.split()], cwd=self.world, stdout=stdout,
                                     stderr=subprocess.PIPE, text=True)
            if run.returncode != 3 or not run.stderr:
                self.findings.append(f"{line} to {device}: status {run.returncode}: {run.stderr}")
        return len(tries)


def main(faultline, out, kills=300, full=20, failing=20, seed=1):
    bench = Bench(faultline, out, int(seed))
    weights = [command.share for command in COMMANDS]
    table = collections.defaultdict(collections.Counter)
    for i, command in enumerate(bench.random.choices(COMMANDS, weights, k=int(kills))):
        killed, writing = bench.kill(command, i)
        table[command.name].update(tries=1, killed=int(killed), writing=int(writing))
    for count, stop, name in ((full, bench.fill_disk, "full"), (failing, bench.limit_size, "failing")):
        for i, command in enumerate(bench.random.choices(COMMANDS, weights, k=int(count))):
            failed = stop(command, i)
            table[command.name].update({name: int(failed is not None), f"{name} told": int(bool(failed))})
    columns = ["tries", "killed", "writing", "full", "full told", "failing", "failing told"]
    print("| command | " + " | ".join(columns) + " |\n|" + "---|" * (1 + len(columns)))
    table["all"] = sum(table.values(), collections.Counter())
    for name, row in table.items():
        print(f"| {name} |", *(f"{row[column]} |" for column in columns))
    print(f"{bench.to_full_device()} results onto a full device\n{len(bench.findings)} findings")
    print("\n".join(bench.findings))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
