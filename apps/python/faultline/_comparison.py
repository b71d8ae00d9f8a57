# SPDX-License-Identifier: MIT
"""Comparing two runs."""
from typing import Any, List, Union

from . import _faultline, _html
from ._arguments import PathLike, Progress, path_of
from ._log import LogLike, log_of
from ._model import Model
from ._record import MadeResult, Record, frame_of


class Comparison(MadeResult):
    """Where two runs differ; attributes are the members of the JSON (schema faultline/comparison/1): same,
    verdict, alignment, signals, notes ..."""

    same: bool
    signals: List[Record]
    notes: List[str]

    def to_html(self) -> str:
        """The page with pictures of all signals."""
        return self._made.html()

    def to_dataframe(self) -> Any:
        """The signals as a pandas DataFrame, one row per signal."""
        return frame_of([signal.to_dict() for signal in self.signals])

    def _repr_html_(self) -> str:
        """The verdict and a table of the signals, for notebooks."""
        heads = ("signal", "joint", "unit", "rms", "largest", "at, s", "threshold", "differs from, s")
        rows = [
            (
                signal.quantity,
                signal.joint,
                signal.unit,
                signal.rms,
                signal.largest,
                _html.seconds(signal.largest_s),
                signal.threshold,
                _html.seconds(signal.diverges_s) if signal.judged else "not judged",
            )
            for signal in self.signals
        ]
        return _html.headline(self.verdict) + _html.table(heads, rows) + _html.listed("Notes", self.notes)


def compare(
    first: LogLike,
    second: LogLike,
    *,
    model: Union[Model, PathLike, None] = None,
    align: str = "auto",
    progress: Progress = None,
) -> Comparison:
    """Compares two runs signal by signal. With a model of the robot (a Model, or the path of one) its columns,
    units and residuals are used. `align` is time (each from its first row), motion, or auto: motion if that is
    better."""
    handle, path = (model._handle, "") if isinstance(model, Model) else (None, path_of(model))
    return Comparison(
        _faultline.compare(log_of(first)._handle, log_of(second)._handle, handle, path, align, progress)
    )
