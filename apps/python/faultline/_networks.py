# SPDX-License-Identifier: MIT
"""The networks of a model on arrays: their inputs for a log, and their outputs."""
from typing import Any, Dict, Mapping

from . import _faultline
from ._arguments import Progress
from ._log import LogLike, log_of
from ._onnx import layouts_of
from .errors import UsageError


def _names_of(handle: Any, network: str) -> Any:
    """Names of the inputs; None for a network that the compiled part is to refuse."""
    for layout in layouts_of(handle):
        if layout["name"] == network:
            return [port["name"] for port in layout["inputs"]]
    return None


def inputs_in(handle: Any, network: str, log: LogLike, progress: Progress) -> Dict[str, Any]:
    """See Model.network_inputs."""
    arrays = _faultline.network_inputs(handle, network, log_of(log)._handle, progress)
    return dict(zip(_names_of(handle, network), arrays))


def outputs_of(handle: Any, network: str, inputs: Mapping[str, Any]) -> Any:
    """See Model.network_outputs."""
    import numpy

    names = _names_of(handle, network)
    if names is not None and sorted(names) != sorted(inputs):
        given = ", ".join(sorted(inputs)) or "nothing"
        raise UsageError(network, f"takes {', '.join(names)}, but was given {given}")
    arrays = []
    for name in names or []:
        try:
            arrays.append(numpy.ascontiguousarray(inputs[name], dtype="float64"))
        except (TypeError, ValueError) as error:
            raise UsageError(name, f"is not a matrix of numbers ({error})") from error
    return _faultline.network_outputs(handle, network, arrays)
