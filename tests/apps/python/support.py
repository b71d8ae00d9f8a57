# SPDX-License-Identifier: MIT
"""What the tests of the module share: the sample logs, a model of them, and the program."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

import faultline

ROOT = pathlib.Path(__file__).resolve().parents[3]
GOLDEN = ROOT / "sample_logs/golden"
BENCH = ROOT / "sample_logs/bench"
LOGS = GOLDEN / "logs"
MODEL = next(GOLDEN.glob("model-*.json"))
CASES = next(GOLDEN.glob("cases-*.db"))
PROGRAM = os.environ["FAULTLINE_PROGRAM"]


def program(*arguments, statuses=(0, 1)):
    """Standard output of the program, as bytes."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, cwd=ROOT)
    if run.returncode not in statuses:
        raise AssertionError(f"status {run.returncode} of {arguments}: {run.stderr.decode()}")
    return run.stdout


def load_model():
    return faultline.load_model(MODEL, cases=CASES)


def columns(path):
    """A CSV as lists of numbers by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


def without_origin(diagnosis):
    """The diagnosis as a dict, without what tells a file from columns in memory."""
    found = diagnosis.to_dict()
    for name in ("path", "sha256", "format"):
        del found["log"][name]
    return found


class InFolder(unittest.TestCase):
    """With a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
