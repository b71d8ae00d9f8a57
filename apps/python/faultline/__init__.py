# SPDX-License-Identifier: MIT
"""Fault diagnosis of SCARA robots from recorded joint logs.

    import faultline
    model = faultline.learn(["healthy_1.csv", "healthy_2.csv"], robot="robot.toml").model
    diagnosis = model.diagnose("bad.csv")
    print(diagnosis.verdict, [(fault.kind, fault.joint, fault.onset_s) for fault in diagnosis.faults])

Logs are paths, dicts of NumPy arrays, pandas DataFrames or faultline.Log. NumPy, pandas, matplotlib and
onnx are imported only by what needs them.
"""
from . import cases, golden
from ._batch import BatchResult, batch, merge_batches
from ._by_robot import logs_by_robot
from ._comparison import Comparison, compare
from ._conversion import Conversion, convert
from ._diagnosis import Curves, Diagnosis, Fault, diagnose
from ._faultline import version as __version__
from ._history import History, history
from ._identification import Identification, identify
from ._inspection import Inspection, inspect
from ._log import Log, open_log
from ._model import Learned, Model, learn, load_model, sign_model
from ._onnx import OnnxFile
from ._record import Record
from ._robots import learn_robots
from ._simulation import reproduce, simulate
from .errors import Error, InputError, InternalError, OutputError, UsageError

__all__ = [
    "BatchResult",
    "Comparison",
    "Conversion",
    "Curves",
    "Diagnosis",
    "Error",
    "Fault",
    "History",
    "Identification",
    "InputError",
    "Inspection",
    "InternalError",
    "Learned",
    "Log",
    "Model",
    "OnnxFile",
    "OutputError",
    "Record",
    "UsageError",
    "__version__",
    "batch",
    "cases",
    "compare",
    "convert",
    "diagnose",
    "golden",
    "history",
    "identify",
    "inspect",
    "learn",
    "learn_robots",
    "load_model",
    "logs_by_robot",
    "merge_batches",
    "open_log",
    "reproduce",
    "sign_model",
    "simulate",
]
