# SPDX-License-Identifier: MIT
"""Golden logs: record the expected results for logs, and check them again later."""
from typing import Any, Iterable, List, Optional, Union

from . import _faultline
from ._arguments import PathLike, Progress, path_of, paths_of
from ._model import Model, files_of
from ._record import Record, Result

__all__ = ["Accepted", "Check", "Recorded", "accept", "check", "record"]


class Recorded(Result):
    """A golden folder that was made: logs (name, verdict, events), identified, skipped (tables of labels)."""

    logs: List[Record]
    identified: bool


class Check(Result):
    """The current results of a golden folder against the expected ones; attributes are the members of the
    JSON (schema faultline/golden-check/1): `result` (same, different or damaged), `items` ..."""

    result: str
    items: List[Record]

    def __init__(self, answer: Any) -> None:
        super().__init__(answer[0])
        self._table = answer[1]

    def text(self) -> str:
        """The report of the terminal."""
        return self._table


class Accepted(Record):
    """What was accepted: `accepted`; and `left`, in which the findings differ from the expected ones."""

    accepted: List[str]
    left: List[str]


def record(
    logs: Union[PathLike, Iterable[PathLike]],
    model: Union[Model, PathLike],
    output: PathLike,
    *,
    cases: Optional[PathLike] = None,
    identify: bool = True,
    trace_points: int = 500,
    threads: int = 0,
    progress: Progress = None,
) -> Recorded:
    """Makes a golden folder: logs, model and their current results. `model` is a Model that has a file, or
    the path of one."""
    its_path, its_cases = files_of(model, cases, "golden.record")
    return Recorded(
        _faultline.golden_record(
            paths_of(logs, "golden.record"),
            its_path,
            its_cases,
            path_of(output),
            identify,
            trace_points,
            threads,
            progress,
        )
    )


def check(
    folder: PathLike,
    *,
    model: Union[Model, PathLike, None] = None,
    cases: Optional[PathLike] = None,
    junit: Optional[PathLike] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Check:
    """Replays all golden logs and compares; changes nothing. `model` stands in for the folder's; `junit` is
    where JUnit XML is written."""
    its_path, its_cases = files_of(model, cases, "golden.check")
    return Check(
        _faultline.golden_check(path_of(folder), its_path, its_cases, path_of(junit), threads, progress)
    )


def accept(
    folder: PathLike,
    names: Iterable[str] = (),
    *,
    all: bool = False,
    same_verdict: bool = False,
    model: Union[Model, PathLike, None] = None,
    cases: Optional[PathLike] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Accepted:
    """Makes different results the expected ones: of the named logs, of all, or of those that differ in
    numbers and reasons only."""
    chosen = [names] if isinstance(names, str) else list(names)
    its_path, its_cases = files_of(model, cases, "golden.accept")
    accepted, left = _faultline.golden_accept(
        path_of(folder), chosen, all, same_verdict, its_path, its_cases, threads, progress
    )
    return Accepted({"accepted": accepted, "left": left})
