# SPDX-License-Identifier: MIT
"""Long work tells how far it is and can be ended."""
import os
import signal
import threading
import time
import unittest

import faultline
from support import BENCH, LOGS, columns, load_model


def long_log(repeats=30):
    """A run over and over again; long enough to be interrupted."""
    run = columns(LOGS / "healthy_quintic.csv")
    step = run["t"][1] - run["t"][0]
    span = run["t"][-1] + step
    out = {name: values * repeats for name, values in run.items() if name != "t"}
    out["t"] = [t + span * i for i in range(repeats) for t in run["t"]]
    return faultline.Log(out, name="long")


class Interrupt(unittest.TestCase):
    def test_ctrl_c_ends_work_soon(self):
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            while time.monotonic() - began < 60:
                faultline.learn(sorted(BENCH.glob("healthy_*.csv")), BENCH / "robot.toml", runs_per_label=100)
        self.assertLess(time.monotonic() - began, 55)

    def test_progress_is_reported_and_what_it_raises_ends_the_work(self):
        reported = []
        load_model().diagnose(long_log(), progress=lambda what, share: reported.append((what, share)))
        self.assertTrue(reported)
        self.assertTrue(all(what == "reading long" and 0 <= share <= 1 for what, share in reported), reported)

        class Enough(Exception):
            pass

        def refuse(what, share):
            raise Enough(what)

        with self.assertRaises(Enough):
            load_model().diagnose(long_log(), progress=refuse)
        self.assertEqual(load_model().diagnose(LOGS / "locked_1.csv").verdict, "faulty")
