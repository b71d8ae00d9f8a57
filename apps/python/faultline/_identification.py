# SPDX-License-Identifier: MIT
"""Identifying a robot."""
from typing import Any, Iterable, List, Optional, Union

from . import _faultline, _html
from ._arguments import PathLike, Progress, path_of
from ._log import LogLike, handles_of
from ._record import MadeResult, Record, frame_of


class Identification(MadeResult):
    """What was identified; attributes are the members of its JSON (schema faultline/identification/1):
    status, base_parameters, physical_parameters, condition_number, residual_rms, fit_r2, logs ..."""

    status: str
    base_parameters: List[Record]
    physical_parameters: List[Record]
    condition_number: Optional[float]
    logs: List[Record]

    def to_html(self) -> str:
        """The page with plots."""
        return self._made.html()

    def to_dataframe(self) -> Any:
        """The base parameters as a pandas DataFrame, one row per parameter."""
        return frame_of([parameter.to_dict() for parameter in self.base_parameters])

    def _repr_html_(self) -> str:
        """The state and a table of the base parameters, for notebooks."""
        meanings = [one["meaning"] if "meaning" in one else "" for one in self.base_parameters]
        heads = ("parameter", "value", "95 % from", "to", "unit", "what it is")
        rows = [
            (
                one.name,
                *((one.value, *one.ci95) if one.identifiable else (None, None, None)),
                one.unit,
                meaning if one.identifiable else f"not identifiable: {one.why_not}",
            )
            for one, meaning in zip(self.base_parameters, meanings)
        ]
        return _html.headline(self.text().splitlines()[0]) + _html.table(heads, rows)

    def robot_text(self, *, urdf: bool = False) -> str:
        """The identified robot as a robot file, or as URDF."""
        return self._made.robot_text("robot.urdf" if urdf else "robot.toml")


def identify(
    logs: Union[LogLike, Iterable[LogLike]],
    robot: PathLike,
    *,
    output: Optional[PathLike] = None,
    method: str = "automatic",
    keep_all: bool = False,
    force: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Identification:
    """Identifies a robot's parameters from logs of healthy runs. With `output` the identified robot is
    written there, as URDF for .urdf. `method` is automatic, weak_form or output_error. `force` also takes
    logs whose numbers are implausible in their units."""
    return Identification(
        _faultline.identify(
            handles_of(logs), path_of(robot), path_of(output), method, keep_all, force, threads, progress
        )
    )
