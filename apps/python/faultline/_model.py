# SPDX-License-Identifier: MIT
"""Models: learned, loaded, used."""
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

from . import _faultline, _html, _onnx
from ._arguments import Label, PathLike, Progress, labels_for, path_of
from ._diagnosis import Diagnosis, diagnosed
from ._log import LogLike, handles_of, log_of
from ._onnx import OnnxFile
from ._record import MadeResult, Record
from .errors import InputError, UsageError

Labels = Union[PathLike, Mapping[str, Label], None]
"""A table file,fault,joint,onset_s, or (fault, joint, onset_s) by name of a log."""


class Sent(NamedTuple):
    """A model on its way to another process: its files, and what must be in them."""

    path: str
    cases: str
    sha256: str
    cases_sha256: str


def _read(sent: Sent) -> _faultline.Model:
    """Raises InputError if the files differ from those that were sent."""
    handle = _faultline.Model(sent.path, sent.cases)
    for file, found, expected in [
        (handle.path, handle.sha256, sent.sha256),
        (handle.cases, handle.cases_sha256, sent.cases_sha256),
    ]:
        if found != expected:
            raise InputError(
                file, "was changed since the pickled model was read; reload() that one and pickle it again"
            )
    return handle


class Model:
    """A learned model with its case base: read once, for any number of logs and threads. `cases` is the case
    base, beside the model by default. Cases that are put into the base later are seen after reload().

    A pickle holds the paths; where it is unpickled the files are read at the first use, and refused when
    they were changed meanwhile. A model in memory only must be saved before it is pickled."""

    _sent: Optional[Sent] = None

    def __init__(self, path: PathLike, *, cases: Optional[PathLike] = None) -> None:
        self._loaded: Optional[_faultline.Model] = _faultline.Model(path_of(path), path_of(cases))

    @classmethod
    def _of(cls, handle: Optional[_faultline.Model], sent: Optional[Sent] = None) -> "Model":
        model = cls.__new__(cls)
        model._loaded = handle
        model._sent = sent
        return model

    @property
    def _handle(self) -> _faultline.Model:
        """Of the compiled part. A pickled model is read here, not where it is unpickled: an error there would
        end the process of a pool, and the pool would wait for ever."""
        if self._loaded is None:
            assert self._sent is not None
            self._loaded = _read(self._sent)
        return self._loaded

    def __reduce__(self) -> Tuple[Any, ...]:
        if self._loaded is None:
            return _unpickled, (self._sent,)
        handle = self._loaded
        if not handle.path:
            raise UsageError(
                "Model", "is in memory only and cannot be sent to another process; save it first"
            )
        return _unpickled, (Sent(handle.path, handle.own_cases, handle.sha256, handle.cases_sha256),)

    def __copy__(self) -> "Model":
        return Model._of(self._loaded, self._sent)

    def __deepcopy__(self, memo: Any) -> "Model":
        return self.__copy__()

    @property
    def path(self) -> str:
        """Where it was read; "" for one that was learned and not written."""
        return self._handle.path

    @property
    def cases(self) -> str:
        """The file of its case base."""
        return self._handle.cases

    @property
    def name(self) -> str:
        """The robot's name."""
        return self._handle.name

    @property
    def sha256(self) -> str:
        """Of the model file."""
        return self._handle.sha256

    @property
    def joints(self) -> int:
        """Axes of the robot."""
        return self._handle.joints

    @property
    def sample_period_s(self) -> float:
        """Of the logs that it was learned from, s."""
        return self._handle.sample_period_s

    @property
    def has_mechanics(self) -> bool:
        """False for a model of logs without torque: it describes how joints follow their references."""
        return self._handle.has_mechanics

    def diagnose(
        self,
        log: LogLike,
        *,
        classify: str = "evidence",
        criterion: str = "log_odds",
        g: int = 0,
        at: Union[float, str, None] = None,
        stop: Optional[str] = None,
        mcap: Optional[PathLike] = None,
        progress: Progress = None,
    ) -> Diagnosis:
        """Finds the faults in one log; see faultline.diagnose."""
        return diagnosed(log, self._handle, classify, criterion, g, at, stop, mcap, progress)

    def robot_text(self) -> str:
        """The identified robot as a robot file."""
        return self._handle.robot_text()

    def to_json(self) -> str:
        """The text of the model file."""
        return self._handle.json()

    def save(self, path: PathLike, *, cases: Optional[PathLike] = None) -> None:
        """Writes model and case base. Cases that people put into an existing case base are carried over. A
        model that was in memory only is from then on bound to these files."""
        self._handle.save(path_of(path), path_of(cases))
        if not self.path:
            self._loaded = _faultline.Model(path_of(path), path_of(cases))

    def reload(self) -> None:
        """Reads model and case base again: cases that were added or revised since are seen."""
        if self._loaded is None and self._sent is not None:
            path, cases = self._sent.path, self._sent.cases
        else:
            path, cases = self._handle.path, self._handle.own_cases
        if not path:
            raise UsageError("Model", "is in memory only and has no file to read again; save it first")
        self._loaded = _faultline.Model(path, cases)

    @property
    def networks(self) -> List[str]:
        """Names of its networks; none in a model of logs without torque."""
        return [layout["name"] for layout in _onnx.layouts_of(self._handle)]

    def network_inputs(self, network: str, log: LogLike, *, progress: Progress = None) -> Dict[str, Any]:
        """The inputs of a network for a log, as NumPy matrices by name of the input, with one row per
        prediction for residual_mlp, per sample for sample_mlp and sample_rbfn, and per episode for
        evidence_mlp and evidence_rbfn. SI units; NaN where something is missing."""
        return _faultline.network_inputs(self._handle, network, log_of(log)._handle, progress)

    def network_outputs(self, network: str, inputs: Mapping[str, Any]) -> Any:
        """The output of a network for matrices of its inputs by name, as a NumPy matrix with as many rows."""
        return _onnx.outputs_of(self._handle, network, inputs)

    def to_onnx(self, folder: PathLike) -> List[OnnxFile]:
        """Writes each of its networks as an ONNX file (opset 15, float64) into the folder, which is made, and
        returns what was written. The graphs contain the scaling of inputs and outputs: they take what
        network_inputs() returns and give what network_outputs() returns. The same model
        gives the same bytes. Needs python3-onnx."""
        return _onnx.export(self._handle, path_of(folder))

    def __repr__(self) -> str:
        return f"faultline.Model({self.path or self.name!r})"


def _unpickled(sent: Sent) -> Model:
    return Model._of(None, sent)


def files_of(model: Union[Model, PathLike, None], cases: Optional[PathLike], what: str) -> Tuple[str, str]:
    """Paths of a model and of its case base, "" for the one beside it."""
    if not isinstance(model, Model):
        return path_of(model), path_of(cases)
    if not model.path:
        raise UsageError(what, "needs a model that is written to a file; save it first")
    return model.path, path_of(cases) or model._handle.own_cases


class Learned(MadeResult):
    """What learning found; attributes are the members of its JSON (schema faultline/learning/1): name,
    identification, doubts, validation, sources, cases ..."""

    name: str
    identification: Record
    validation: Record

    def __init__(self, made: Any) -> None:
        super().__init__(made)
        self._model: Optional[Model] = None

    @property
    def model(self) -> Model:
        """The model, ready to diagnose with."""
        if self._model is None:
            self._model = Model._of(self._made.model())
        return self._model

    def _repr_html_(self) -> str:
        """What was learned, and what the model finds in simulated runs of faults, for notebooks."""
        if "validation" not in self:
            return _html.report(self.text())
        heads = ("simulated fault", "runs", "found", "right joint", "right fault and joint", "delay, s")
        rows = [
            (
                row.kind.replace("_", " "),
                row.runs,
                row.detected,
                row.right_joint,
                row.right_kind_and_joint,
                _html.seconds(row.median_delay_s),
            )
            for row in self.validation.rows
        ]
        doubts = self.doubts if "doubts" in self else []
        return (
            _html.headline(self.text().splitlines()[0])
            + _html.table(heads, rows)
            + _html.listed("Doubts about this model", doubts, is_open=True)
        )


def load_model(path: PathLike, *, cases: Optional[PathLike] = None) -> Model:
    """Reads a model and its case base."""
    return Model(path, cases=cases)


def sign_model(path: PathLike, *, why: str = "") -> bool:
    """Accepts a model file that was edited by hand, in place; each report made with it then states that it was
    edited and `why`. Returns False for a file that was not edited, which stays as it is."""
    return bool(_faultline.sign_model(path_of(path), why))


def learn(
    logs: Union[LogLike, Iterable[LogLike]],
    robot: PathLike,
    *,
    output: Optional[PathLike] = None,
    cases: Optional[PathLike] = None,
    labels: Labels = None,
    runs_per_label: int = 3,
    alarms_per_hour: float = 0.01,
    keep_all: bool = False,
    force: bool = False,
    seed: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> Learned:
    """Learns a model of one robot from logs of healthy runs, and labelled ones of faults if there are any.
    `robot` is a robot file or the axes alone, such as "RRP". With `output` the model is written there, and
    its case base beside it or to `cases`. The other options are those of `faultline learn`."""
    options: Dict[str, Any] = {
        "runs_per_label": runs_per_label,
        "alarms_per_hour": alarms_per_hour,
        "keep_all": keep_all,
        "force": force,
        "seed": seed,
        "threads": threads,
    }
    handles = handles_of(logs)
    in_memory = labels_for(labels, handles) if isinstance(labels, Mapping) else {}
    label_file = "" if isinstance(labels, Mapping) else path_of(labels)
    return Learned(
        _faultline.learn(
            handles,
            path_of(robot),
            path_of(output),
            path_of(cases),
            label_file,
            in_memory,
            options,
            progress,
        )
    )
