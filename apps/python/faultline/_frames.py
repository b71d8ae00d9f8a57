# SPDX-License-Identifier: MIT
"""Columns in memory as contiguous arrays of float64: those that are that already are taken as they are."""
import datetime
import sys
from collections.abc import Mapping as MappingType
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from .errors import InputError, UsageError

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


def _dates(values: Any) -> Any:
    """Python's and pandas' dates in an array of objects, with a zone or without, as datetime64 in UTC."""
    import numpy

    def date(value: Any) -> Any:
        if value is None or value != value:  # NaN, NaT
            return numpy.datetime64("NaT")
        if not isinstance(value, datetime.datetime):
            raise TypeError("not a date")
        if value.tzinfo is not None:
            value = value.astimezone(datetime.timezone.utc).replace(tzinfo=None)
        return value.to_datetime64() if hasattr(value, "to_datetime64") else numpy.datetime64(value)

    return numpy.array([date(value) for value in values], dtype="datetime64[ns]")


def _pandas_values(values: Any) -> Any:
    """A Series, Index or array of pandas; missing values of its own types become NaN, times are in UTC."""
    import numpy

    kind = getattr(values.dtype, "kind", "O")
    if kind == "M":
        return numpy.asarray(values, dtype="datetime64[ns]")
    if kind == "m" or type(values.dtype).__module__.startswith("numpy") and kind != "O":
        return values.to_numpy()
    try:
        return values.to_numpy(dtype="float64", na_value=float("nan"))
    except (TypeError, ValueError):
        return values.to_numpy()


def _unmasked(values: Any) -> Any:
    """An array with a mask; what is masked becomes NaN."""
    import numpy

    if values.mask is numpy.ma.nomask or values.dtype.kind == "c":
        return values.data
    if values.dtype.kind in "mM":
        return values.filled(numpy.array("NaT", dtype=values.dtype))
    return values.astype("float64" if values.dtype.kind in "biuf" else "O").filled(numpy.nan)


def _without_na(array: Any) -> Any:
    """An array of objects in which pandas.NA is NaN."""
    pandas = sys.modules.get("pandas")  # without it no value of its types is there
    if pandas is None or array.dtype.kind != "O":
        return array
    array = array.copy()
    array[pandas.isna(array)] = float("nan")
    return array


def _array_of(name: str, values: Any) -> Tuple[Optional[Any], str]:
    """The array, or None for text, and its unit where it is known."""
    import numpy

    if type(values).__module__.partition(".")[0] == "pandas" and hasattr(values, "to_numpy"):
        values = _pandas_values(values)
    array = _unmasked(values) if isinstance(values, numpy.ma.MaskedArray) else numpy.asarray(values)
    if array.ndim != 1:
        raise InputError(
            f"column {name}", f"has {array.ndim} dimensions; give one array of numbers per column"
        )
    if array.dtype.kind in "mM":
        return _seconds(array), "s"
    if array.dtype.kind == "c":
        raise InputError(f"column {name}", "holds complex numbers; give real ones")
    array = _without_na(array)
    try:
        return numpy.ascontiguousarray(array, dtype="float64"), ""
    except (TypeError, ValueError):
        pass
    try:
        return _seconds(_dates(array)), "s"
    except (TypeError, ValueError):
        return None, ""


def _index_of(frame: Any) -> List[Tuple[str, Any]]:
    """The index, if it is named or holds times."""
    index = frame.index
    if getattr(index, "nlevels", 1) != 1:
        return []
    if index.name is not None and str(index.name) not in map(str, frame.columns):
        return [(str(index.name), index)]
    if index.name is None and getattr(index.dtype, "kind", "O") in "mM":
        return [("t", index)]
    return []


def _told_units(units: Any, names: List[str]) -> Dict[str, str]:
    """The units by name of a column, checked."""
    if not isinstance(units, MappingType):
        raise UsageError("units", f'{units!r} is not a dict of units by column, such as {{"q1": "deg"}}')
    for name, unit in units.items():
        if str(name) not in names:
            raise UsageError("units", f'"{name}" is not a column; there are {", ".join(names)}')
        if not isinstance(unit, str):
            raise UsageError(f"units, {name}", f'{unit!r} is not a unit; give its symbol, such as "deg"')
    return {str(name): unit for name, unit in units.items()}


def columns_of(value: Any, units: Any) -> Columns:
    """The columns of a mapping of names to arrays, or of a DataFrame; `units` of some by name."""
    if is_frame(value):
        columns = _index_of(value)
        columns += [(str(name), value.iloc[:, i]) for i, name in enumerate(value.columns)]
    else:
        columns = [(str(name), values) for name, values in value.items()]
    if not columns:
        raise InputError("the log", "has no column; a log needs at least a time and a position")
    names = [name for name, _ in columns]
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"column {twice}", "appears twice; give each column its own name")
    given = _told_units(units, names)
    arrays, told = zip(*(_array_of(name, values) for name, values in columns))
    return Columns(names, [given.get(name, unit) for name, unit in zip(names, told)], list(arrays))
