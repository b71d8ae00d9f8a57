# SPDX-License-Identifier: MIT
"""What is kept of a diagnosis in a pickle."""
from typing import Any, Dict, NamedTuple

from .errors import UsageError

FORMATS = ("json", "csv", "md", "junit")
WIDTH, UNICODE, COLOR = 80, True, False

WHY = "a pickle holds neither the log nor the model; "


class KeptReports(NamedTuple):
    """Reports as text, in the place of a diagnosis of the compiled part."""

    line: str
    report: str
    rendered: Dict[str, str]

    def sentence(self) -> str:
        return self.line

    def text(self, width: int, unicode: bool, color: bool) -> str:
        if (width, unicode, color) != (WIDTH, UNICODE, COLOR):
            raise UsageError("text", "of a pickled diagnosis is available only without other arguments")
        return self.report

    def render(self, format: str, progress: Any) -> str:
        if format not in self.rendered:
            raise UsageError(
                "to_html", WHY + "make the page where the log was diagnosed, or diagnose it again"
            )
        return self.rendered[format]

    def curves(self, bins: int, progress: Any) -> Dict[str, Any]:
        raise UsageError("curves", WHY + "take them where the log was diagnosed, or diagnose it again")


def kept(made: Any) -> KeptReports:
    """Of a diagnosis of the compiled part, or of what is kept of one."""
    if isinstance(made, KeptReports):
        return made
    reports = {format: made.render(format, None) for format in FORMATS}
    return KeptReports(made.sentence(), made.text(WIDTH, UNICODE, COLOR), reports)
