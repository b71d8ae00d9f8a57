# SPDX-License-Identifier: MIT
"""Logs: files, or columns in memory."""
import os
from collections.abc import Mapping as MappingType
from typing import Any, Dict, Iterable, List, Mapping, Optional, Tuple, Union

from . import _faultline
from ._arguments import PathLike, Progress, path_of
from ._frames import columns_of, is_frame
from ._record import Record, Result
from .errors import UsageError

NAME_IN_MEMORY = "frame"

LogLike = Union[PathLike, Mapping[str, Any], "Log", Any]
"""A path, a mapping of names to arrays, a pandas DataFrame, or a Log."""


class Log:
    """A log: a file, a mapping of column names to arrays, or a pandas DataFrame. Columns are found as in
    files: t, q1.., dq1.., tau1.. or what a robot file's [log] defines.

    Columns of contiguous float64 are read where they are and must not change while they are read; others are
    copied. `then` are files that continue the log, `join` files with more columns of it (`join_by` auto,
    row or time), `run` reads one run only of a log in which the clock restarts (from 1; 0: all). `units`
    gives the units of columns in memory, such as {"q1": "deg"}; reports call them `name`.
    """

    def __init__(
        self,
        source: LogLike,
        *,
        name: Optional[str] = None,
        units: Optional[Mapping[str, str]] = None,
        then: Iterable[PathLike] = (),
        join: Iterable[PathLike] = (),
        join_by: str = "auto",
        run: int = 0,
    ) -> None:
        if isinstance(source, (str, os.PathLike)):
            if name is not None or units is not None:
                raise UsageError("Log", "name and units are for columns in memory; a file has its own name")
            self._parts = (
                path_of(source),
                [path_of(p) for p in then],
                [path_of(p) for p in join],
                join_by,
                run,
            )
            self._handle = _faultline.Log(*self._parts)
            return
        if list(then) or list(join):
            raise UsageError("Log", "then and join are for files; combine columns in memory first")
        if not is_frame(source) and not isinstance(source, MappingType):
            raise UsageError(
                "Log",
                f"{type(source).__name__} is not a log; give a path, a dict of arrays, a DataFrame or a Log",
            )
        columns = columns_of(source, {} if units is None else units)
        self._handle = _faultline.Log.of_columns(name or NAME_IN_MEMORY, *columns, run)

    def __reduce__(self) -> Tuple[Any, ...]:
        if not self._handle.is_file:
            raise UsageError("Log", "of columns in memory cannot be pickled; send the columns")
        return _unpickled, self._parts

    def __copy__(self) -> "Log":
        return self

    def __deepcopy__(self, memo: Any) -> "Log":
        return self

    @property
    def name(self) -> str:
        """The path, or the name given to columns in memory."""
        return self._handle.name

    @property
    def columns(self) -> List[str]:
        """Names of the columns in the log."""
        return self._handle.columns()

    def to_dict(
        self, *, robot: Optional[PathLike] = None, extra: bool = True, progress: Progress = None
    ) -> Dict[str, Any]:
        """The channels in SI units as NumPy arrays by name: t, q1.., dq1.., tau1..; `robot` is a robot file
        that defines what columns mean; `extra` keeps columns without a meaning, too. Rows without a usable
        time are left out."""
        return self._handle.read(path_of(robot), extra, progress)[0]

    def to_dataframe(
        self, *, robot: Optional[PathLike] = None, extra: bool = True, progress: Progress = None
    ) -> Any:
        """The same as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self.to_dict(robot=robot, extra=extra, progress=progress), copy=False)

    def facts(self, *, robot: Optional[PathLike] = None, progress: Progress = None) -> Record:
        """How the log is read: path, sha256, format, rows, issues."""
        return Result(self._handle.read(path_of(robot), False, progress)[2])

    def __repr__(self) -> str:
        return f"faultline.Log({self.name!r})"


def _unpickled(path: str, then: List[str], join: List[str], join_by: str, run: int) -> Log:
    return Log(path, then=then, join=join, join_by=join_by, run=run)


def open_log(
    path: PathLike,
    *,
    then: Iterable[PathLike] = (),
    join: Iterable[PathLike] = (),
    join_by: str = "auto",
    run: int = 0,
) -> Log:
    """A log file of any known format; see Log."""
    log = Log(path, then=then, join=join, join_by=join_by, run=run)
    log.columns  # a file that cannot be read is told here
    return log


def log_of(source: LogLike) -> Log:
    """What was given as a log, as one."""
    return source if isinstance(source, Log) else Log(source)


def logs_of(logs: Union[LogLike, Iterable[LogLike]]) -> List[Log]:
    """One log or several. Frames without a name are counted."""
    if isinstance(logs, (str, os.PathLike, Log, MappingType)) or is_frame(logs):
        return [log_of(logs)]
    found = []
    for number, one in enumerate(logs, 1):
        in_memory = isinstance(one, MappingType) or is_frame(one)
        found.append(Log(one, name=f"{NAME_IN_MEMORY} {number}") if in_memory else log_of(one))
    return found


def handles_of(logs: Union[LogLike, Iterable[LogLike]]) -> List[Any]:
    """The same for the compiled part."""
    return [log._handle for log in logs_of(logs)]
