# SPDX-License-Identifier: MIT
"""Results whose attributes have the names of their JSON."""
import json
from typing import Any, ClassVar, Dict, Iterator, List, Mapping, Type

from .errors import UsageError


class Record:
    """A JSON object as attributes: record.verdict, record["verdict"]. Objects inside are Records, lists are
    lists; a missing number is None. It cannot be changed."""

    _parts: ClassVar[Mapping[str, Type["Record"]]] = {}
    """Classes of members that have one of their own."""

    def __init__(self, members: Mapping[str, Any]) -> None:
        self._members = dict(members)

    def _wrapped(self, name: str, value: Any) -> Any:
        if isinstance(value, dict):
            return self._parts.get(name, Record)(value)
        if isinstance(value, list):
            return [self._wrapped(name, item) for item in value]
        return value

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._wrapped(name, self._members[name])
        except KeyError:
            known = ", ".join(sorted(self._members))
            raise AttributeError(f"{type(self).__name__} has no {name}; there are {known}") from None

    def __getitem__(self, name: str) -> Any:
        return self._wrapped(name, self._members[name])

    def __contains__(self, name: object) -> bool:
        return name in self._members

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)

    def __dir__(self) -> List[str]:
        return sorted({*super().__dir__(), *self._members})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self._members == other._members

    def __hash__(self) -> int:
        return hash(json.dumps(self._members, sort_keys=True))

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={value!r}" for name, value in self._members.items() if _is_short(value))
        return f"{type(self).__name__}({shown})"

    def to_dict(self) -> Dict[str, Any]:
        """The members as dicts, lists, numbers and text; a copy."""
        return json.loads(json.dumps(self._members))


def _is_short(value: Any) -> bool:
    return value is None or isinstance(value, (int, float, str))


class Result(Record):
    """The result of a function, made of its JSON."""

    def __init__(self, text: str) -> None:
        super().__init__(json.loads(text))
        self._text = text

    def __getstate__(self) -> Dict[str, Any]:
        if "_made" in self.__dict__:
            raise UsageError(type(self).__name__, "cannot be pickled; send its to_json() or to_dict()")
        return self.__dict__

    def __copy__(self) -> "Result":
        return self

    def __deepcopy__(self, memo: Any) -> "Result":
        return self

    def to_json(self) -> str:
        """The JSON of the program, byte for byte."""
        return self._text


class MadeResult(Result):
    """A result that the compiled part holds, too."""

    def __init__(self, made: Any) -> None:
        super().__init__(made.json())
        self._made = made

    def text(self) -> str:
        """The summary of the terminal."""
        return self._made.text()


def frame_of(rows: List[Dict[str, Any]]) -> Any:
    """A pandas DataFrame with one row per item of `rows`. Raises ImportError without pandas."""
    import pandas

    return pandas.DataFrame(rows)
