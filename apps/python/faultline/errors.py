# SPDX-License-Identifier: MIT
"""Exceptions of faultline, with the messages of the program."""
from typing import Any, ClassVar, Optional, Tuple


class Error(Exception):
    """Something cannot be done. `where` is the file, and row or key inside it; `message` says what was found,
    what was expected and what to do; `code` is the kind of trouble, as the class."""

    code: ClassVar[str] = "error"
    where: str
    message: str

    def __init__(self, where: str, message: str, sentence: Optional[str] = None) -> None:
        super().__init__(sentence or (f"{where}: {message}" if where else message))
        self.where = where
        self.message = message

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.where, self.message, str(self))


class UsageError(Error):
    """An argument or an option file (robot file, spec) is wrong; exit status 2 of the program."""

    code = "usage"


class InputError(Error):
    """A log, model, case base or label file cannot be processed; exit status 3 of the program."""

    code = "input"


class OutputError(Error):
    """A result cannot be written; exit status 3 of the program."""

    code = "output"


class InternalError(Error):
    """A defect of faultline; please report it. Exit status 4 of the program."""

    code = "internal"
