# SPDX-License-Identifier: MIT
"""Runs a command and writes its wall time, processor time (s) and peak memory (MB) to a file.

Usage: measured_run.py FILE COMMAND [ARGUMENT ...]
"""
import resource
import subprocess
import sys
import time

begin = time.monotonic()
status = subprocess.run(sys.argv[2:]).returncode
wall = time.monotonic() - begin
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(sys.argv[1], "w") as out:
    out.write(f"{wall:.1f} {usage.ru_utime + usage.ru_stime:.1f} {usage.ru_maxrss / 1024:.0f}\n")
sys.exit(status)
