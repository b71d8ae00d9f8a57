# SPDX-License-Identifier: MIT
"""The lines of the page on notebooks run, with simulated robots in the place of the reader's own."""
import contextlib
import io
import os
import re
import shutil
import unittest
import unittest.mock

import numpy
import pandas

import faultline
from small_robots import FAULTS, HEALTHY, OfRobots, table_of
from support import ROOT


class Page(OfRobots):
    def test_the_lines_of_the_page_run(self):
        page = (ROOT / "docs/how-to/notebook.md").read_text()
        first, frames, robots = re.findall(r"```python\n(.*?)```", page, re.S)
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        shutil.copy(self.files["cell-1"], "robot.toml")
        for run in HEALTHY:
            self.frames["cell-1"][run].to_csv(f"healthy_{run}.csv", index=False)
        self.frames["cell-1"]["bad"].to_csv("bad.csv", index=False)
        known = {"pandas": pandas}
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(first, known)
        self.assertIn("% ", printed.getvalue())
        self.assertEqual(faultline.load_model("robot.model").sha256, known["learned"].model.sha256)
        self.expect_fault_of_first(known["diagnosis"])

        bad = self.frames["cell-1"]["bad"]
        known["frame"] = bad.assign(t=1000 * bad["t"], q1=numpy.degrees(bad["q1"])).rename(
            columns={"t": "timestamp", "q1": "actual_q_1", "q2": "actual_q_2"}
        )
        with unittest.mock.patch.object(pandas, "read_parquet", lambda path: bad):
            exec(frames, known)
        self.expect_fault_of_first(known["learned"].model.diagnose(known["log"]))

        renamed = {"robot": "robot_id"}
        known["frame"] = table_of(self.coarse).rename(columns=renamed)
        known["new"] = table_of(self.coarse, ("bad",)).rename(columns=renamed)
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            exec(robots, known)
        lines = printed.getvalue().splitlines()
        self.assertEqual([line.partition(" run bad ")[0] for line in lines], list(FAULTS))
        self.assertTrue(all(" run bad " in line for line in lines), lines)

    def expect_fault_of_first(self, diagnosis):
        self.assertEqual([(fault.kind, fault.joint) for fault in diagnosis.faults], [FAULTS["cell-1"]])


if __name__ == "__main__":
    unittest.main()
