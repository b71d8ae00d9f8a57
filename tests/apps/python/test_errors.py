# SPDX-License-Identifier: MIT
"""What fails, fails with the sentences of the program."""
import os
import pathlib
import pickle
import subprocess
import unittest

import faultline
from support import CASES, LOGS, MODEL, PROGRAM, InFolder


class Errors(InFolder):
    def sentence_of_program(self, *arguments):
        run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
        self.assertGreater(run.returncode, 1)
        return run.stderr.strip().removeprefix("faultline: ")

    def test_a_missing_log_is_told_as_the_program_tells_it(self):
        missing = self.folder / "missing.csv"
        with self.assertRaises(faultline.InputError) as caught:
            faultline.diagnose(missing, MODEL, cases=CASES)
        error = caught.exception
        self.assertEqual(error.code, "input")
        self.assertEqual(error.where, str(missing))
        self.assertEqual(str(error), f"{error.where}: {error.message}")
        self.assertEqual(
            str(error), self.sentence_of_program("diagnose", missing, "--model", MODEL, "--cases", CASES)
        )

    def test_each_kind_of_trouble_has_its_class(self):
        bad_robot = self.folder / "robot.toml"
        bad_robot.write_text('axes = "RXP"\n')
        nowhere = self.folder / "no/such/folder/robot.toml"
        healthy = LOGS / "healthy_quintic.csv"
        for kind, code, call in [
            (faultline.UsageError, "usage", lambda: faultline.identify(healthy, bad_robot)),
            (
                faultline.UsageError,
                "usage",
                lambda: faultline.diagnose(healthy, MODEL, cases=CASES, classify="x"),
            ),
            (faultline.UsageError, "usage", lambda: faultline.learn([], "RRP")),
            (faultline.InputError, "input", lambda: faultline.load_model(healthy)),
            (faultline.InputError, "input", lambda: faultline.inspect(self.folder)),
            (faultline.OutputError, "output", lambda: faultline.identify(healthy, "RRP", output=nowhere)),
            (faultline.UsageError, "usage", lambda: faultline.cases.list()),
        ]:
            with self.assertRaises(kind) as caught:
                call()
            self.assertEqual(caught.exception.code, code)
            self.assertIsInstance(caught.exception, faultline.Error)

    def test_a_result_takes_no_inputs_place(self):
        log = self.folder / "run.csv"
        log.write_bytes((LOGS / "healthy_quintic.csv").read_bytes())
        with self.assertRaisesRegex(faultline.UsageError, "would overwrite the log"):
            faultline.identify(log, "RRP", output=log)
        self.assertEqual(log.read_bytes(), (LOGS / "healthy_quintic.csv").read_bytes())

    def test_errors_can_be_pickled(self):
        error = faultline.InputError("run.csv", "is empty", "run.csv: is empty")
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual(
            (type(again), again.where, str(again)), (faultline.InputError, "run.csv", str(error))
        )

    def test_text_and_paths_both_name_files(self):
        log = LOGS / "healthy_quintic.csv"
        for path in (str(log), log, pathlib.PurePath(log)):
            self.assertEqual(faultline.open_log(path).name, os.fspath(log))
        with self.assertRaises(TypeError):
            faultline.load_model(17)


if __name__ == "__main__":
    unittest.main()
