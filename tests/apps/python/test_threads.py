# SPDX-License-Identifier: MIT
"""One model serves many threads, and other threads go on meanwhile."""
import concurrent.futures
import threading
import time
import unittest

from support import LOGS, columns, load_model

import faultline


class Threads(unittest.TestCase):
    def test_logs_diagnosed_at_once_are_those_diagnosed_in_turn(self):
        model = load_model()
        logs = sorted(LOGS.glob("*.csv")) + [faultline.Log(columns(LOGS / "locked_1.csv"), name="frame")]
        in_turn = [model.diagnose(log).to_json() for log in logs]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            at_once = list(pool.map(lambda log: model.diagnose(log).to_json(), 3 * logs))
        self.assertEqual(at_once, 3 * in_turn)

    def test_other_threads_run_while_a_log_is_diagnosed(self):
        model = load_model()
        count = 0
        done = threading.Event()

        def diagnose():
            for _ in range(3):
                for log in LOGS.glob("*.csv"):
                    model.diagnose(log)
            done.set()

        worker = threading.Thread(target=diagnose)
        worker.start()
        while not done.is_set():
            count += 1
            time.sleep(0.001)
        worker.join()
        self.assertGreater(count, 20)
