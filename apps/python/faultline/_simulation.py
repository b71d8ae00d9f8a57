# SPDX-License-Identifier: MIT
"""Simulated runs, and the paper rebuilt."""
from typing import List, Optional

from . import _faultline
from ._arguments import PathLike, Progress, path_of
from ._record import Record, Result


class Simulation(Result):
    """What was simulated; attributes are the members of its JSON (schema faultline/simulation/1)."""

    robot: str
    runs: List[Record]


class Reproduction(Result):
    """The reproduction; attributes are the members of index.json."""


def simulate(
    spec: PathLike, output: PathLike, *, seed: Optional[int] = None, progress: Progress = None
) -> Simulation:
    """Simulates the runs of a spec file into the folder `output`: logs and labels.csv."""
    return Simulation(_faultline.simulate(path_of(spec), path_of(output), seed, progress))


def reproduce(
    output: PathLike,
    *,
    quick: bool = False,
    seeds: Optional[int] = None,
    seed: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> Reproduction:
    """Rebuilds the tables and figures of the paper behind the method into the folder `output`."""
    return Reproduction(_faultline.reproduce(path_of(output), quick, seeds, seed, threads, progress))
