#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Memory and processor time that hostile files take; called by hostile_files.sh.

Usage: hostile_files.py PROGRAM FOLDER MODEL [WORD...]: only files whose names hold one of the words.
"""
import os
import signal
import sys

MOST_MEMORY_MB, MOST_TIME_S = 300, 10
LARGEST = 2_000_000  # bytes of a file for which the bounds hold


def run(program, arguments, out):
    """Status, peak memory in MB, processor time in s and what was said. This process stays small: what a child takes
    includes its parent's memory until it becomes another program."""
    with open(out, "wb") as said:
        actions = [(os.POSIX_SPAWN_DUP2, said.fileno(), 1), (os.POSIX_SPAWN_DUP2, said.fileno(), 2)]
        child = os.posix_spawn("/usr/bin/timeout", ["timeout", "120", program, *arguments], os.environ,
                               file_actions=actions)
        _, status, used = os.wait4(child, 0)
    with open(out, "rb") as said:
        text = said.read(4000).decode(errors="replace")
    return os.waitstatus_to_exitcode(status), used.ru_maxrss / 1024, used.ru_utime + used.ru_stime, text


def main(program, folder, model, words):
    broken = 0
    files = sorted(name for name in os.listdir(folder) if name[0] != "." and (not words or any(word in name for word in words)))
    print(f"{'file':36} {'bytes':>8} {'command':9} {'MB':>5} {'s':>6}  status, last line")
    for name in files:
        path = os.path.join(folder, name)
        size = os.path.getsize(path)
        out = os.path.join(os.path.dirname(folder), "said.txt")
        result = os.path.join(os.path.dirname(folder), "converted.csv")
        for command, arguments in (("inspect", ["inspect", path]), ("convert", ["convert", path, result]),
                                   ("diagnose", ["diagnose", path, "--model", model])):
            status, memory, time, text = run(program, arguments, out)
            bad = status not in (0, 1, 2, 3) or (size <= LARGEST and (memory > MOST_MEMORY_MB or time > MOST_TIME_S))
            broken += bad
            if os.path.exists(result):
                os.remove(result)
            lines = [line for line in text.splitlines() if line.strip()]
            last = " ".join(lines[-1:])[:110] if status > 1 or status < 0 else ""
            print(f"{name:36} {size:8} {command:9} {memory:5.0f} {time:6.2f}  {status} {last}{' <-- BROKEN' if bad else ''}",
                  flush=True)
    print(f"{broken} runs took more than {MOST_MEMORY_MB} MB or {MOST_TIME_S} s, or crashed")
    return 1 if broken else 0


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]))
