# SPDX-License-Identifier: MIT
"""Columns in memory as contiguous arrays of float64: those that are that already are taken as they are."""
from typing import Any, List, Mapping, NamedTuple, Optional, Tuple

from .errors import InputError

NANOSECONDS = 1_000_000_000


class Columns(NamedTuple):
    """None in place of an array: a column of text."""

    names: List[str]
    units: List[str]
    arrays: List[Optional[Any]]


def is_frame(value: Any) -> bool:
    """Whether it is a pandas DataFrame, without importing pandas."""
    return type(value).__module__.partition(".")[0] == "pandas" and hasattr(value, "columns")


def _seconds(values: Any) -> Any:
    """Dates as seconds since 1970, durations as seconds."""
    import numpy

    is_date = values.dtype.kind == "M"
    counts = values.astype("datetime64[ns]" if is_date else "timedelta64[ns]")
    missing = numpy.isnat(counts)
    whole, rest = numpy.divmod(counts.astype("int64"), NANOSECONDS)
    seconds = whole.astype("float64") + rest.astype("float64") / NANOSECONDS
    seconds[missing] = numpy.nan
    return seconds


def _array_of(name: str, values: Any) -> Tuple[Optional[Any], str]:
    """The array, or None for text, and its unit where it is known."""
    import numpy

    array = numpy.asarray(values)
    if array.ndim != 1:
        raise InputError(f"column {name}", f"has {array.ndim} dimensions; give one array of numbers a column")
    if array.dtype.kind in "mM":
        return _seconds(array), "s"
    if array.dtype.kind == "c":
        raise InputError(f"column {name}", "holds complex numbers; give real ones")
    try:
        return numpy.ascontiguousarray(array, dtype="float64"), ""
    except (TypeError, ValueError):
        return None, ""


def _series_values(series: Any) -> Any:
    """A column of a DataFrame; missing values of pandas' own types become NaN."""
    kind = getattr(series.dtype, "kind", "O")
    if kind not in "biuf" or type(series.dtype).__module__.startswith("numpy"):
        return series.to_numpy()
    return series.to_numpy(dtype="float64", na_value=float("nan"))


def _index_of(frame: Any) -> List[Tuple[str, Any]]:
    """The index, where it is named or tells times."""
    index = frame.index
    if getattr(index, "nlevels", 1) != 1:
        return []
    if index.name is not None and str(index.name) not in map(str, frame.columns):
        return [(str(index.name), index.to_numpy())]
    if index.name is None and getattr(index.dtype, "kind", "O") in "mM":
        return [
            (
                "t",
                index.tz_convert("UTC").tz_localize(None).to_numpy()
                if getattr(index, "tz", None)
                else index.to_numpy(),
            )
        ]
    return []


def columns_of(value: Any, units: Mapping[str, str]) -> Columns:
    """The columns of a mapping of names to arrays, or of a DataFrame."""
    if is_frame(value):
        columns = _index_of(value)
        columns += [(str(name), _series_values(value.iloc[:, i])) for i, name in enumerate(value.columns)]
    else:
        columns = [(str(name), values) for name, values in value.items()]
    if not columns:
        raise InputError("the log", "has no column; a log has a time and a position at least")
    names = [name for name, _ in columns]
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"column {twice}", "is there twice; give each column a name of its own")
    arrays, told = zip(*(_array_of(name, values) for name, values in columns))
    return Columns(names, [units.get(name, unit) for name, unit in zip(names, told)], list(arrays))
