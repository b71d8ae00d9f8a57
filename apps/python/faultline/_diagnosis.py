# SPDX-License-Identifier: MIT
"""Diagnosing a log."""
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union

from . import _faultline, _html
from ._arguments import PathLike, Progress, path_of
from ._kept import COLOR, UNICODE, WIDTH, kept
from ._log import LogLike, log_of
from ._record import Record, Result, frame_of

if TYPE_CHECKING:
    from ._model import Model

NO_NESTED = ("precedents", "could_also_be", "evidence", "opinions")


class Fault(Record):
    """A fault that was found: kind, joint (None: of no joint), onset_s, alarm_s, end_s, confidence, opinions,
    decided_by, precedents, could_also_be, evidence, next_check."""

    id: int
    kind: str
    joint: Optional[int]
    onset_s: Optional[float]
    alarm_s: Optional[float]
    end_s: Optional[float]
    confidence: float
    decided_by: str
    next_check: str
    opinions: Record
    precedents: List[Record]
    could_also_be: List[Record]
    evidence: List[Record]


class Curves:
    """The course of a run in bins, as NumPy arrays by name: `whole`, and `faults`, a stretch around each of
    the first faults. Signals (t, q1, q1_predicted, dq1, tau1, tau1_required ...) have two values per bin, its
    extremes; residuals (t_residual, residual1 ...) one, the largest in the bin; `healthy_residual` is the
    largest of each joint in healthy logs."""

    def __init__(self, found: Dict[str, Any]) -> None:
        self.whole: Dict[str, Any] = found["whole"]
        self.faults: List[Dict[str, Any]] = found["faults"]
        self.healthy_residual: List[float] = found["healthy_residual"]
        self.by_reference: bool = found["by_reference"]
        self.alarm_ratio: float = found["alarm_ratio"]

    def to_dataframe(self) -> Any:
        """The residuals of the whole run as a pandas DataFrame: t, residual1, ..."""
        import pandas

        named = {name: self.whole[name] for name in self.whole if name.startswith("residual")}
        return pandas.DataFrame({"t": self.whole.get("t_residual", []), **named})

    def __repr__(self) -> str:
        return f"faultline.Curves({len(self.whole.get('t', ()))} points, {len(self.faults)} faults)"


class Diagnosis(Result):
    """What was found in a log; attributes are the members of the JSON report: verdict (healthy, faulty or
    inconclusive), verdict_reason, score (None if the torque balance did not judge the log), faults, residuals,
    condition, cannot_see, log, model, program. A pickle keeps them and the reports, without what reads the log
    again: to_html() and curves()."""

    _parts = {"faults": Fault}
    verdict: str
    score: Optional[Record]
    faults: List[Fault]
    residuals: List[Record]
    condition: List[Record]
    cannot_see: List[str]
    log: Record
    model: Record

    def __init__(self, made: Any) -> None:
        super().__init__(made.render("json", None))
        self._made = made

    def __reduce__(self) -> Tuple[Any, ...]:
        return Diagnosis, (kept(self._made),)

    @property
    def sentence(self) -> str:
        """The verdict in one sentence."""
        return self._made.sentence()

    def text(self, *, width: int = WIDTH, unicode: bool = UNICODE, color: bool = COLOR) -> str:
        """The report of the terminal."""
        return self._made.text(width, unicode, color)

    def to_html(self, *, progress: Progress = None) -> str:
        """The self-contained page with plots. Reads the log once more."""
        return self._made.render("html", progress)

    def to_csv(self) -> str:
        """One row per fault, as CSV."""
        return self._made.render("csv", None)

    def to_markdown(self) -> str:
        """Markdown for an issue tracker."""
        return self._made.render("md", None)

    def to_junit(self) -> str:
        """JUnit XML for a CI server."""
        return self._made.render("junit", None)

    def to_dataframe(self) -> Any:
        """The faults as a pandas DataFrame, one row per fault."""
        return frame_of(
            [{k: v for k, v in fault.to_dict().items() if k not in NO_NESTED} for fault in self.faults]
        )

    def curves(self, *, bins: int = 2000, progress: Progress = None) -> Curves:
        """The course of the run as arrays, in at most so many bins. Reads the log once more."""
        return Curves(self._made.curves(bins, progress))

    def plot(self, *, bins: int = 500, progress: Progress = None) -> Any:
        """A matplotlib Figure with the residuals of all joints and the faults. Reads the log once more."""
        from ._plot import figure_of

        return figure_of(self, self.curves(bins=bins, progress=progress))

    def _repr_html_(self) -> str:
        """The verdict and a table of the faults, for notebooks."""
        heads = ("fault", "joint", "from, s", "to, s", "confidence", "next check")
        rows = [
            (
                fault.kind.replace("_", " "),
                fault.joint,
                _html.seconds(fault.onset_s),
                "end of log" if fault.end_s is None else _html.seconds(fault.end_s),
                round(fault.confidence, 2),
                fault.next_check,
            )
            for fault in self.faults
        ]
        return (
            _html.headline(self.sentence)
            + _html.table(heads, rows)
            + _html.listed("What is imperfect in this log", _html.doubts_of(self.log.issues), is_open=True)
            + _html.listed("What this log cannot show", self.cannot_see)
        )


def diagnose(
    log: LogLike,
    model: Union["Model", PathLike],
    *,
    cases: Optional[PathLike] = None,
    classify: str = "evidence",
    criterion: str = "log_odds",
    g: int = 0,
    at: Union[float, str, None] = None,
    stop: Optional[str] = None,
    mcap: Optional[PathLike] = None,
    progress: Progress = None,
) -> Diagnosis:
    """Finds the faults in one log. `model` is a Model, or the path of one with its case base `cases` (beside
    it by default). `classify` is evidence or samples (the method of the paper, with `criterion` log_odds or
    consecutive and `g`). `at` is the moment of a stop, in seconds of the log or as a date with a time, `stop`
    the column whose first change is that moment: the diagnosis then says what changed before it. `mcap` is a
    file for the log with predictions, residuals, evidence and events."""
    from ._model import Model

    loaded = model if isinstance(model, Model) else Model(path_of(model), cases=cases)
    return loaded.diagnose(
        log, classify=classify, criterion=criterion, g=g, at=at, stop=stop, mcap=mcap, progress=progress
    )


def diagnosed(
    log: LogLike,
    handle: Any,
    classify: str,
    criterion: str,
    g: int,
    at: Union[float, str, None],
    stop: Optional[str],
    mcap: Optional[PathLike],
    progress: Progress,
) -> Diagnosis:
    """The same with a model of the compiled part."""
    moment = "" if at is None else at if isinstance(at, str) else repr(float(at))
    made = _faultline.diagnose(
        log_of(log)._handle, handle, classify, criterion, g, moment, stop or "", progress
    )
    if mcap is not None:
        made.record(path_of(mcap), progress)
    return Diagnosis(made)
