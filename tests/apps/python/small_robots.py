# SPDX-License-Identifier: MIT
"""Two simulated robots that are learned in some seconds, and tests with their runs as frames."""
import pathlib
import tempfile

import pandas

import faultline
from support import InFolder

ROBOT = """name = "two joints"
axes = "RR"
known = {{l1 = {length}}}
log = {{torque = "commanded", torque_between_samples = "held"}}
"""
SPEC = """format = "csv"
seed = {seed}
duration_s = 12.0
sample_period_s = 0.05
control_period_s = "held"
record_reference = true
noise = {{q = [5e-4, 5e-4], dq = [2e-3, 2e-3]}}
robot = {{name = "two joints", axes = "RR", known = {{m1 = {mass}, m2 = 0.8, l1 = {length}, l2 = 0.8}}}}
motion = {{low = [-2.0, -2.0], high = [2.0, 2.0]}}
run = [
  {{name = "1"}},
  {{name = "2", motion = {{profile = "trapezoidal", low = [-2.0, -2.0], high = [2.0, 2.0]}}}},
  {{name = "3"}},
  {{name = "bad", fault = {{kind = "{fault}", joint = {joint}, onset_s = 5.0, size = 0.5}}}},
]
"""
HEALTHY = ("1", "2", "3")
FAULTS = {"cell-1": ("locked", 1), "cell-2": ("torque_loss", 2)}
"""Of the bad run of each robot."""


def make_robots(folder):
    """Robot files by robot, and the frames of its runs by robot and run."""
    files, frames = {}, {}
    for seed, (robot, (fault, joint)) in enumerate(FAULTS.items()):
        truth = {"seed": 10 * seed, "mass": 1.0 + seed, "length": 1.0 - 0.2 * seed}
        truth.update(fault=fault, joint=joint)
        spec = SPEC.replace(", size = 0.5", "") if fault == "locked" else SPEC
        files[robot] = folder / f"{robot}.toml"
        files[robot].write_text(ROBOT.format(**truth))
        (folder / f"{robot}.spec.toml").write_text(spec.format(**truth))
        faultline.simulate(folder / f"{robot}.spec.toml", folder / robot)
        frames[robot] = {
            run: pandas.read_csv(folder / robot / f"{run}.csv", float_precision="round_trip")
            for run in (*HEALTHY, "bad")
        }
    return files, frames


def named(frames, robot, runs=HEALTHY):
    """The runs of one robot, called as logs_by_robot calls them."""
    return [faultline.Log(frames[robot][run], name=f"{robot} run {run}") for run in runs]


def table_of(frames, runs=HEALTHY):
    """The rows of all robots and runs, mixed: sorted by time, so that rows of one time are neighbours."""
    parts = [frames[robot][run].assign(robot=robot, run=run) for robot in frames for run in runs]
    return pandas.concat(parts).sort_values("t", kind="stable").reset_index(drop=True)


class OfRobots(InFolder):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.made = pathlib.Path(folder.name)
        cls.files, cls.frames = make_robots(cls.made)
        cls.coarse = {
            robot: {run: frame.drop(columns=["tau1", "tau2"]) for run, frame in runs.items()}
            for robot, runs in cls.frames.items()
        }
        """Without torque, which is learned in a moment."""

    def learn_coarse(self, table=None, **options):
        given = {"by": "robot", "run": "run", **options}
        robot = given.pop("robot", self.files)
        return faultline.learn_robots(table_of(self.coarse) if table is None else table, robot, **given)

    def files_below(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))
