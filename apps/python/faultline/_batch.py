# SPDX-License-Identifier: MIT
"""Diagnosing all logs of folders."""
import json
import pathlib
from typing import Any, Iterable, List, Mapping, Optional, Tuple, Union

from . import _faultline, _html
from ._arguments import PathLike, Progress, path_of, paths_of
from ._model import Model, files_of
from ._record import Record, Result, frame_of
from .errors import UsageError


class BatchResult(Result):
    """A finished batch; attributes are the members of its summary.json. `diagnosed` is the number of logs
    that this call diagnosed; the others were diagnosed before."""

    def __init__(self, answer: Any, folder: str) -> None:
        super().__init__(answer[0])
        self._summary = answer[1]
        self.diagnosed: int = answer[2]
        self.folder = folder

    def text(self) -> str:
        """The summary of the terminal."""
        return self._summary

    @property
    def rows(self) -> List[Record]:
        """One row per log, as in index.ndjson."""
        index = pathlib.Path(self.folder) / "index.ndjson"
        return [Record(json.loads(line)) for line in index.read_text("utf-8").splitlines() if line]

    def to_dataframe(self) -> Any:
        """The rows as a pandas DataFrame."""
        return frame_of([row.to_dict() for row in self.rows])

    def _repr_html_(self) -> str:
        """The counts and a table of the logs, for notebooks."""
        heads = ("log", "model", "verdict", "reason", "faults")
        rows = [
            (row.log, row.model, row.verdict, row.reason, "; ".join(map(_html.finding, row.faults)))
            for row in self.rows
        ]
        return _html.headline(self.text().splitlines()[0]) + _html.table(heads, rows)


def _models_of(
    model: Union[Model, PathLike, Mapping[str, Union[Model, PathLike]]], cases: Optional[PathLike]
) -> List[Tuple[str, Any]]:
    if not isinstance(model, Mapping):
        model = {"": model}
    elif cases is not None and len(model) > 1:
        raise UsageError(
            f"cases={cases}", "applies to a batch with one model; of several models, each uses its own"
        )
    handles = []
    for folder, given in model.items():
        loaded = given if isinstance(given, Model) else Model(given, cases=cases)
        files_of(loaded, None, "batch")
        handles.append((str(folder), loaded._handle))
    return handles


def batch(
    paths: Union[PathLike, Iterable[PathLike]],
    model: Union[Model, PathLike, Mapping[str, Union[Model, PathLike]]],
    output: PathLike,
    *,
    cases: Optional[PathLike] = None,
    html: bool = False,
    identify: bool = False,
    threads: int = 0,
    shard: Optional[str] = None,
    wait: bool = False,
    progress: Progress = None,
) -> BatchResult:
    """Diagnoses every log below the paths into the folder `output`, with an index; an earlier run there is
    continued. `model` may be a dict of models by the folder whose logs each is for, "" for all other logs.
    The options are those of `faultline batch`."""
    folder = path_of(output)
    found = paths_of(paths, "batch")
    answer = _faultline.batch(
        found, _models_of(model, cases), folder, html, identify, threads, shard or "", wait, progress
    )
    return BatchResult(answer, folder)


def merge_batches(folders: Iterable[PathLike], output: PathLike) -> BatchResult:
    """Puts the finished shards of one batch together into the folder `output`."""
    into = path_of(output)
    return BatchResult(_faultline.merge_batches(paths_of(folders, "merge_batches"), into), into)
