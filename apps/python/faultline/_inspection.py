# SPDX-License-Identifier: MIT
"""Looking at a log."""
import json
from typing import Any, List, Optional

from . import _faultline, _html
from ._arguments import PathLike, Progress, path_of
from ._log import LogLike, log_of
from ._record import Record, Result, frame_of


class Inspection(Result):
    """The contents of a log; attributes are those of its entry in the JSON (schema faultline/inspection/1):
    verdict, joint_log, joints, rows, channels, issues, lacking, analyses ..."""

    verdict: str
    joints: int
    rows: int
    channels: List[Record]
    issues: List[Record]
    analyses: List[Record]

    def __init__(self, made: Any) -> None:
        super().__init__(made.json())
        self._members = json.loads(self._text)["logs"][0]
        self._made = made

    def text(self, *, color: bool = False) -> str:
        """The report of the terminal."""
        return self._made.text(color)

    def to_html(self) -> str:
        """The page with pictures of all channels."""
        return self._made.html()

    def to_dataframe(self) -> Any:
        """The channels as a pandas DataFrame, one row per channel."""
        return frame_of([channel.to_dict() for channel in self.channels])

    def _repr_html_(self) -> str:
        """The summary and a table of the channels, for notebooks."""
        heads = ("channel", "column", "unit", "least", "largest", "missing")
        rows = [
            (channel.name, channel.column, channel.unit, channel.min, channel.max, channel.missing)
            for channel in self.channels
        ]
        abilities = [
            f"{one.name.replace('_', ' ')}: {one.fit}" + (f", {one.why}" if one.why else "")
            for one in self.analyses
        ]
        return (
            _html.headline(self.text().splitlines()[0].replace("  ", ": ", 1))
            + _html.table(heads, rows)
            + _html.listed("What is imperfect in this log", _html.doubts_of(self.issues), is_open=True)
            + _html.listed("What this log is good for", abilities)
        )


def inspect(log: LogLike, *, robot: Optional[PathLike] = None, progress: Progress = None) -> Inspection:
    """Reports what a log contains and what is wrong with it. `robot` is a robot file that defines the
    columns."""
    return Inspection(_faultline.inspect(log_of(log)._handle, path_of(robot), progress))
