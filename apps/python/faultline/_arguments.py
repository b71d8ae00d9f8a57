# SPDX-License-Identifier: MIT
"""Arguments as the compiled part takes them."""
import numbers
import os
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Tuple, Union

from .errors import UsageError

PathLike = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]
"""Receives what is being done and the share done, 0 to 1; an exception from it ends the work."""

Label = Tuple[str, int, float]

WHAT_IT_IS = (
    'a label is (fault, joint, onset_s), such as ("locked", 2, 4.2) with the joint counted from 1 and the '
    'onset in seconds of the log; of a healthy log ("none", 0, 0)'
)


def path_of(path: Optional[PathLike]) -> str:
    """A path as text, "" for none."""
    return "" if path is None else os.fsdecode(os.fspath(path))


def paths_of(paths: Union[PathLike, Iterable[PathLike]], what: str) -> List[str]:
    """One path or several."""
    found = [path_of(paths)] if isinstance(paths, (str, os.PathLike)) else [path_of(path) for path in paths]
    if not found:
        raise UsageError(what, "needs at least one path")
    return found


def text_of(key: Any) -> str:
    """The name of a log as text, of a path or of anything else."""
    return os.fsdecode(key) if isinstance(key, (str, bytes, os.PathLike)) else str(key)


def _label(name: str, given: Any) -> Label:
    is_label = (
        isinstance(given, (tuple, list))
        and len(given) == 3
        and isinstance(given[0], str)
        and isinstance(given[1], numbers.Integral)
        and isinstance(given[2], numbers.Real)
    )
    if not is_label:
        raise UsageError(f"labels, {name}", f"{given!r} is not a label; {WHAT_IT_IS}")
    return given[0], int(given[1]), float(given[2])


def labels_for(labels: Mapping[Any, Any], logs: List[Any]) -> Dict[str, Label]:
    """The labels of the logs (of the compiled part). Logs are named as reports name them; of a path the last
    part counts."""
    names = [os.path.basename(log.name) for log in logs]
    found = {}
    for key, given in labels.items():
        name = text_of(key)
        found[name] = _label(name, given)
        if os.path.basename(name) not in names:
            raise UsageError(f"labels, {name}", f"is not one of the logs, which are: {', '.join(names)}")
    return found
