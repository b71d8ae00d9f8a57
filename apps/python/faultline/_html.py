# SPDX-License-Identifier: MIT
"""Results as HTML for the cells of a notebook. All text is escaped."""
import html
from typing import Any, Iterable, List, Optional, Sequence

MOST_ROWS = 40
"""Of a table in a cell; the frame has all."""
DIGITS = 5
"""That an estimate is shown with."""
LEFT = "text-align:left"
ONE_LINE = "white-space:nowrap"


class Seconds(float):
    """A time, which counts from 1970 in some logs."""


def _is_text(value: Any) -> bool:
    return isinstance(value, (str, bool))


def _cell(tag: str, value: Any, is_text: bool) -> str:
    style = ";".join([LEFT] * is_text + [ONE_LINE] * (tag == "th"))
    if value is None:
        value = ""
    elif isinstance(value, Seconds):
        value = f"{value:.3f}"
    elif isinstance(value, float):
        value = f"{value:.{DIGITS}g}"
    text = str(value)
    return f"<{tag}" + (f' style="{style}">' if style else ">") + f"{html.escape(text)}</{tag}>"


def _row(tag: str, cells: Iterable[Any], texts: Iterable[bool]) -> str:
    return "<tr>" + "".join(_cell(tag, *cell) for cell in zip(cells, texts)) + "</tr>"


def seconds(value: Optional[float]) -> Optional[Seconds]:
    """To be shown to the millisecond."""
    return None if value is None else Seconds(value)


def headline(text: str) -> str:
    """A sentence that stands above what follows."""
    return f"<p><b>{html.escape(text)}</b></p>"


def table(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """A table of numbers and text, "" without rows; None is an empty cell. Notebooks set cells to the right,
    which is for numbers."""
    if not rows:
        return ""
    texts = [any(map(_is_text, column)) for column in zip(*rows)]
    more = len(rows) - MOST_ROWS
    rest = f"<p>and {more} more rows: to_dataframe()</p>" if more > 0 else ""
    body = "".join(_row("td", row, map(_is_text, row)) for row in rows[:MOST_ROWS])
    return f"<table><thead>{_row('th', heads, texts)}</thead><tbody>{body}</tbody></table>{rest}"


def listed(summary: str, lines: List[str], is_open: bool = False) -> str:
    """Lines behind a summary that opens them, "" without lines."""
    if not lines:
        return ""
    items = "".join(f"<li>{html.escape(line)}</li>" for line in lines)
    how = " open" if is_open else ""
    return f"<details{how}><summary>{html.escape(summary)}</summary><ul>{items}</ul></details>"


def report(text: str) -> str:
    """A report of the terminal."""
    return f"<pre>{html.escape(text)}</pre>"


def finding(fault: Any) -> str:
    """Fault and joint in some words, such as "locked, joint 1"."""
    kind = fault.kind.replace("_", " ")
    return f"{kind}, joint {fault.joint}" if fault.joint else kind


def doubts_of(issues: Iterable[Any]) -> List[str]:
    """What was imperfect in a log and matters."""
    return [f"{issue.channel}: {issue.message}" for issue in issues if issue.severity != "note"]
