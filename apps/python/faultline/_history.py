# SPDX-License-Identifier: MIT
"""The results of many batches, by robot."""
from typing import Any, Iterable, List, Union

from . import _faultline, _html
from ._arguments import PathLike, path_of, paths_of
from ._record import MadeResult, Record, frame_of


class History(MadeResult):
    """The robots of a history file; attributes are the members of the JSON (schema faultline/history/1):
    `robots` ... Of the results that this call gave, `added` are new, `replaced` took the place of another
    result of the same log and model, and `known` were there before."""

    robots: List[Record]

    def __init__(self, made: Any) -> None:
        super().__init__(made)
        self.added, self.replaced, self.known = made.growth

    def to_html(self) -> str:
        """The page with a line a robot."""
        return self._made.html()

    def to_dataframe(self) -> Any:
        """The robots as a pandas DataFrame, one row per robot."""
        return frame_of(
            [
                {k: v for k, v in robot.to_dict().items() if not isinstance(v, (dict, list))}
                for robot in self.robots
            ]
        )

    def _repr_html_(self) -> str:
        """A line a robot, for notebooks."""
        heads = ("robot", "logs", "healthy", "faulty", "inconclusive", "worst finding")
        rows = [
            (
                robot.robot,
                robot.logs,
                robot.healthy,
                robot.faulty,
                robot.inconclusive,
                "" if robot.worst_finding is None else _html.finding(robot.worst_finding),
            )
            for robot in self.robots
        ]
        return _html.headline(f"{len(rows)} robot{'s' * (len(rows) != 1)}") + _html.table(heads, rows)


def history(
    db: PathLike,
    results: Union[PathLike, Iterable[PathLike]] = (),
    *,
    robots: Union[str, Iterable[str]] = (),
) -> History:
    """Adds results (folders of batches, JSON files of diagnoses) to the history file `db`, which is made if it
    is not there, and reads it. `robots` names those that are wanted; all without it."""
    given = results if isinstance(results, str) or hasattr(results, "__fspath__") else list(results)
    added = paths_of(given, "history") if given else []
    wanted = [robots] if isinstance(robots, str) else list(robots)
    return History(_faultline.history(added, path_of(db), wanted))
