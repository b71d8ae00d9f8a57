# SPDX-License-Identifier: MIT
"""The rows of several robots in one table, as logs by robot and run."""
from collections.abc import Iterable as IterableType
from collections.abc import Mapping as MappingType
from typing import Any, Dict, Hashable, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

from ._arguments import PathLike
from ._frames import is_frame
from ._log import Log
from .errors import InputError, UsageError

Frames = Union[Any, Mapping[str, Any], Iterable[Any]]
"""A pandas DataFrame, a dict of arrays, or several of them."""

RobotFiles = Union[PathLike, Mapping[Any, PathLike]]
"""One robot file for all robots, or a robot file by robot."""

CLOCK_ISSUES = ("clock_restart", "time_repeated", "time_backward", "time_out_of_order")


def _listed(names: Iterable[Any]) -> str:
    return ", ".join(map(str, names))


def _frame_of(given: Any) -> Any:
    import pandas

    if not isinstance(given, MappingType):
        kind = type(given).__name__
        raise UsageError("frame", f"{kind} is not a table; give a DataFrame or a dict of arrays")
    try:
        return pandas.DataFrame(given)
    except ValueError as error:
        raise InputError("frame", f"is not a table: {error}") from None


def _tables_of(frame: Frames, columns: List[Tuple[str, Hashable]]) -> List[Any]:
    """DataFrames in which each of the columns (argument, name) is one without missing values."""
    several = not is_frame(frame) and not isinstance(frame, MappingType)
    tables = []
    for given in frame if several and isinstance(frame, IterableType) else [frame]:
        table = given if is_frame(given) else _frame_of(given)
        levels = [name for _, name in columns if name in table.index.names and name not in table.columns]
        tables.append(table.reset_index(level=levels) if levels else table)
    for table in tables:
        for argument, name in columns:
            found = list(table.columns).count(name)
            if found != 1:
                why = "is in two columns" if found else "is not a column"
                raise UsageError(argument, f'"{name}" {why}; there are {_listed(table.columns)}')
            missing = table[name].isna().to_numpy()
            if missing.any():
                raise InputError(
                    f"column {name}",
                    f"is empty in {missing.sum()} of {len(table)} rows, first in row {missing.argmax() + 1}; "
                    f"fill it, or leave these rows out: frame.dropna(subset=[{name!r}])",
                )
    return tables


def _parts(table: Any, name: Hashable) -> List[Tuple[Any, Any]]:
    """The rows of each value of a column, in the order of their first rows, without the column. A whole
    number is an int, whatever type the column has."""
    parts = []
    for value, rows in table.groupby(table[name].to_numpy(), sort=False):
        value = value.item() if hasattr(value, "item") else value
        whole = isinstance(value, float) and value.is_integer()
        parts.append((int(value) if whole else value, rows.drop(columns=name)))
    return parts


def _without_columns_of_others(robots: Mapping[Any, Mapping[int, Any]]) -> Dict[Any, Dict[int, Any]]:
    """Without those that a robot has no value in, and another one has."""
    filled = {
        name: {column for part in parts.values() for column in part.columns[part.notna().any().to_numpy()]}
        for name, parts in robots.items()
    }
    of_any = set().union(*filled.values())
    return {
        name: {
            number: part.drop(columns=[column for column in part if column in of_any - filled[name]])
            for number, part in parts.items()
        }
        for name, parts in robots.items()
    }


def _joined(parts: Mapping[int, Any]) -> Any:
    import pandas

    return pandas.concat(parts.values()) if len(parts) > 1 else next(iter(parts.values()))


def check_clock(robot: Any, log: Log, file: Optional[PathLike], run: Optional[Hashable]) -> None:
    """Raises InputError if the time of a log does not increase: two runs in one log would be read as one."""
    try:
        issues = log.facts(robot=file).issues
    except InputError as error:
        if file is None:
            return  # the columns have names of their own, which the model knows
        raise InputError(f"robot {robot}, {error.where}", error.message) from None
    for issue in issues:
        if issue.code not in CLOCK_ISSUES:
            continue
        if run is None:
            what = 'these are probably several runs: name the column that numbers them, such as run="episode"'
        else:
            what = f'column "{run}" does not separate the runs, or the rows are not in order of time'
        why = f"the time does not increase ({issue.message}); {what}"
        raise InputError(f"robot {robot}, {log.name}", why)


class Run(NamedTuple):
    """A run of a robot, with the rows of its table."""

    log: Log
    rows: int


def split(frame: Frames, by: Hashable, run: Optional[Hashable]) -> Dict[Any, List[Run]]:
    """The runs of each robot; their times are not looked at."""
    if run is not None and run == by:
        raise UsageError("run", f'"{run}" is the column of the robots; name the one that numbers their runs')
    tables = _tables_of(frame, [("by", by)] + ([] if run is None else [("run", run)]))
    rows: Dict[Any, Dict[int, Any]] = {}
    for number, table in enumerate(tables, 1):
        for name, part in _parts(table, by):
            rows.setdefault(name, {})[number] = part
    robots: Dict[Any, List[Run]] = {}
    for name, parts in _without_columns_of_others(rows).items():
        if run is not None:
            runs = [(f"{name} {run} {which}", part) for which, part in _parts(_joined(parts), run)]
        elif len(tables) > 1:
            runs = [(f"{name} frame {number}", part) for number, part in parts.items()]
        else:
            runs = [(f"{name}", part) for part in parts.values()]
        robots[name] = [Run(Log(part, name=title), len(part)) for title, part in runs]
    if not robots:
        raise InputError("frame", "has no rows, so there is no robot in it")
    return robots


def file_of(robot: RobotFiles, name: Any) -> PathLike:
    if not isinstance(robot, MappingType):
        return robot
    for key in (name, str(name)):
        if key in robot:
            return robot[key]
    raise UsageError("robot", f"has no robot file for {name}; there are those of {_listed(robot)}")


def logs_by_robot(
    frame: Frames, by: Hashable, *, run: Optional[Hashable] = None, robot: Optional[RobotFiles] = None
) -> Dict[Any, List[Log]]:
    """The runs of each robot by its id, from a table with the rows of several robots: a DataFrame, a dict of
    arrays, or several of them. Column `by` holds the ids, column `run` the run, counted for each robot or for
    all. Rows of robots and runs may be mixed. Without `run` the rows of a robot in one table are one run. A
    time that does not increase within a run is refused. A column that is empty for a robot and not for all of
    them belongs to the others, which may have more joints, and is left out. Reports call a log by id and run,
    such as "cell-1 run 3". `robot` is a robot file that defines columns, or a dict of them by id. Needs
    pandas."""
    found = split(frame, by, run)
    for name, runs in found.items():
        for each in runs:
            check_clock(name, each.log, None if robot is None else file_of(robot, name), run)
    return {name: [each.log for each in runs] for name, runs in found.items()}
