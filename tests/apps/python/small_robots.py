# SPDX-License-Identifier: MIT
"""Two simulated robots that are learned in some seconds, and their runs as frames."""
import faultline

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
FAULTS = {"cell-1": ("locked", 1), "cell-2": ("torque_loss", 2)}
"""Of the bad run of each robot."""


def make_robots(folder):
    """Robot files by robot, and the frames of its runs by robot and run."""
    import pandas

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
            for run in ("1", "2", "3", "bad")
        }
    return files, frames
