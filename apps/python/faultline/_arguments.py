# SPDX-License-Identifier: MIT
"""Arguments as the compiled part takes them."""
import os
from typing import Callable, Iterable, List, Optional, Union

from .errors import UsageError

PathLike = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]
"""Receives what is being done and the share done, 0 to 1; an exception from it ends the work."""


def path_of(path: Optional[PathLike]) -> str:
    """A path as text, "" for none."""
    return "" if path is None else os.fsdecode(os.fspath(path))


def paths_of(paths: Union[PathLike, Iterable[PathLike]], what: str) -> List[str]:
    """One path or several."""
    found = [path_of(paths)] if isinstance(paths, (str, os.PathLike)) else [path_of(path) for path in paths]
    if not found:
        raise UsageError(what, "needs at least one path")
    return found
