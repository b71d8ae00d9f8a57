# SPDX-License-Identifier: MIT
"""Writing a log in another format."""
import json
from typing import List, Optional

from . import _faultline
from ._arguments import PathLike, Progress, path_of
from ._log import LogLike, log_of
from ._record import Record


class Conversion(Record):
    """A log that was written: `path`, `rows_read`, `rows_written`, `issues`; and `lost_values`, whether rows,
    values or signals were lost, which the written log records, too."""

    path: str
    rows_read: int
    rows_written: int
    lost_values: bool
    issues: List[Record]


def convert(
    log: LogLike,
    output: PathLike,
    *,
    robot: Optional[PathLike] = None,
    diagnosis: Optional[PathLike] = None,
    progress: Progress = None,
) -> Conversion:
    """Writes a log in the format of the extension of `output`, its columns as channels in SI units. `robot` is
    a robot file that defines what columns mean, `diagnosis` the JSON report of this log, whose events a .mcap
    holds."""
    made = _faultline.convert(
        log_of(log)._handle, path_of(output), path_of(robot), path_of(diagnosis), progress
    )
    return Conversion(json.loads(made))
