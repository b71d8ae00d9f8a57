# SPDX-License-Identifier: MIT
"""Diagnosing all logs of folders."""
import json
import pathlib
from typing import Any, Iterable, List, Optional, Union

from . import _faultline
from ._arguments import PathLike, Progress, path_of, paths_of
from ._model import Model
from ._record import Record, Result, frame_of
from .errors import UsageError


class BatchResult(Result):
    """A finished batch; attributes are the members of its summary.json. `diagnosed` is the number of logs
    that were diagnosed by this call, the others were done before."""

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
        """A row each log, as in index.ndjson."""
        index = pathlib.Path(self.folder) / "index.ndjson"
        return [Record(json.loads(line)) for line in index.read_text("utf-8").splitlines() if line]

    def to_dataframe(self) -> Any:
        """The rows as a pandas DataFrame."""
        return frame_of([row.to_dict() for row in self.rows])


def batch(
    paths: Union[PathLike, Iterable[PathLike]],
    model: Union[Model, PathLike],
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
    """Diagnoses every log below the paths into the folder `output`, with an index; an earlier run there goes
    on. The options are those of `faultline batch`."""
    loaded = model if isinstance(model, Model) else Model(model, cases=cases)
    if not loaded.path:
        raise UsageError("batch", "needs a model that is written to a file; save it before")
    folder = path_of(output)
    found = paths_of(paths, "batch")
    answer = _faultline.batch(
        found, loaded._handle, folder, html, identify, threads, shard or "", wait, progress
    )
    return BatchResult(answer, folder)


def merge_batches(folders: Iterable[PathLike], output: PathLike) -> BatchResult:
    """Puts the finished shards of one batch together into the folder `output`."""
    into = path_of(output)
    return BatchResult(_faultline.merge_batches(paths_of(folders, "merge_batches"), into), into)
