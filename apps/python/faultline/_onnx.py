# SPDX-License-Identifier: MIT
"""The networks of a model: on arrays, and as ONNX files."""
import hashlib
import json
from typing import Any, Callable, Dict, List, Mapping, Tuple

from . import _faultline
from ._onnx_graph import Graph, onnx_module
from ._record import Record
from .errors import InputError, UsageError

MOST_RATIO = 2.0
"""Of torque residual to torque, either way, as the sample classifiers see it."""
EPSILON = 3.0
"""Healthy rms of the torque residual below which a torque hardly counts in that ratio."""

Members = Mapping[str, Any]


class OnnxFile(Record):
    """A network that was written: path, sha256, network (its name), what, inputs and output (name, columns,
    units, what)."""

    path: str
    sha256: str
    network: str
    what: str
    inputs: List[Record]
    output: Record


def _residual_mlp(graph: Graph, model: Members) -> str:
    part = model["residual"]
    turning = [joint for joint, turns in enumerate(part["turns"]) if turns]
    seen = ["q", "dq", "tau", "mean_tau"] if part["uses_mean_torque"] else ["q", "dq", "tau"]
    if turning:  # seen by sine in place of the angle, cosines behind the rest
        each = [graph.columns("q", [joint]) for joint in range(len(part["turns"]))]
        sines = [graph.op("Sin", q) if joint in turning else q for joint, q in enumerate(each)]
        seen = [*sines, *seen[1:], *(graph.cosine(each[joint]) for joint in turning)]
    scaled = graph.scaled(graph.beside(*seen), part["inputs"])
    return graph.unscaled(graph.mlp(scaled, part["mlp"]), part["outputs"])


def _sample_features(graph: Graph, model: Members) -> str:
    part = model["samples"]["classifier"]
    if part["features"] == "velocity":
        return "velocity_residual"
    rms = graph.vector("torque_rms", part["torque_rms"])
    residual, torque = (graph.op("Div", name, rms) for name in ("torque_residual", "torque"))
    if part["features"] == "hypotheses":
        free = graph.op("Div", graph.op("Add", "torque_residual", "torque"), rms)
        return graph.beside(*(graph.asinh_of_magnitude(values) for values in (residual, free, torque)))
    healthy = model["residual"]["healthy"]["torque_rms"]
    floor = graph.vector("floor", [EPSILON * EPSILON * (rms * rms) for rms in healthy])
    power = graph.op("Add", graph.op("Mul", "torque", "torque"), floor)
    ratio = graph.op("Div", graph.op("Mul", "torque_residual", "torque"), power)
    return graph.beside(
        graph.asinh(residual), graph.asinh_of_magnitude(torque), graph.clipped(ratio, MOST_RATIO)
    )


def _classifier(kind: str, features: Callable[[Graph, Members], str], *place: str) -> Callable[..., str]:
    """Of the model file's part at `place`."""

    def build(graph: Graph, model: Members) -> str:
        part = model
        for name in place:
            part = part[name]
        scaled = graph.scaled(features(graph, model), part["scaler"])
        return graph.mlp(scaled, part["mlp"]) if kind == "mlp" else graph.rbfn(scaled, part["rbfn"])

    return build


def _evidence_features(graph: Graph, model: Members) -> str:
    return "features"


BUILDERS: Dict[str, Callable[[Graph, Members], str]] = {
    "residual_mlp": _residual_mlp,
    "evidence_mlp": _classifier("mlp", _evidence_features, "judges"),
    "evidence_rbfn": _classifier("rbfn", _evidence_features, "judges"),
    "sample_mlp": _classifier("mlp", _sample_features, "samples", "classifier"),
    "sample_rbfn": _classifier("rbfn", _sample_features, "samples", "classifier"),
}


def layouts_of(handle: Any) -> List[Dict[str, Any]]:
    """Name, what, inputs and output of each network of a model of the compiled part."""
    return json.loads(_faultline.network_layouts(handle))


def outputs_of(handle: Any, network: str, inputs: Members) -> Any:
    """See Model.network_outputs."""
    import numpy

    named = {layout["name"]: [port["name"] for port in layout["inputs"]] for layout in layouts_of(handle)}
    names = named.get(network, [])  # the compiled part refuses an unknown network
    if network in named and sorted(names) != sorted(inputs):
        given = ", ".join(sorted(inputs)) or "nothing"
        raise UsageError(network, f"takes {', '.join(names)}, but was given {given}")
    arrays = []
    for name in names:
        try:
            arrays.append(numpy.ascontiguousarray(inputs[name], dtype="float64"))
        except (TypeError, ValueError) as error:
            raise UsageError(name, f"is not a matrix of numbers ({error})") from error
    return _faultline.network_outputs(handle, network, arrays)


def _properties(layout: Members, model: Members, sha256: str) -> Dict[str, str]:
    def columns(port: Members) -> Dict[str, Any]:
        return {"name": port["name"], "columns": port["columns"], "units": port["units"], "what": port["what"]}

    properties = {
        "network": layout["name"],
        "robot": model["name"],
        "model_sha256": sha256,
        "inputs": json.dumps([columns(port) for port in layout["inputs"]]),
        "output": json.dumps(columns(layout["output"])),
    }
    if layout["name"] == "residual_mlp":
        shape = model["residual"]["shape"]
        properties["step_s"] = repr(shape["step_s"])
        properties["step_rows"] = str(shape["step"])
    else:
        properties["classes"] = json.dumps(layout["output"]["columns"])
    return properties


def _document(layout: Members, model: Members) -> str:
    step = model["residual"]["shape"]["step_s"]
    text = f"{layout['what']}. Robot: {model['name']}. Output: {layout['output']['what']}."
    if layout["name"] == "residual_mlp":
        text += f" step_s is {step!r}."
    return text + " One part of a faultline model; a diagnosis needs more than its networks."


def _file_of(layout: Members, model: Members, sha256: str) -> bytes:
    graph = Graph()
    result = BUILDERS[layout["name"]](graph, model)
    return graph.to_bytes(
        layout, result, _document(layout, model), _properties(layout, model, sha256), _faultline.version
    )


def export(handle: Any, folder: str) -> List[OnnxFile]:
    """Writes one file per network."""
    layouts = layouts_of(handle)
    if not layouts:
        raise InputError(
            handle.path or handle.name,
            "was learned from logs without torque; such a model has no networks to export",
        )
    onnx_module()
    text = handle.json()
    sha256 = handle.sha256 or hashlib.sha256(text.encode()).hexdigest()
    model = json.loads(text)
    files: List[Tuple[str, bytes]] = [
        (f"{layout['name']}.onnx", _file_of(layout, model, sha256)) for layout in layouts
    ]
    paths = _faultline.write_networks(handle, folder, files)
    return [
        OnnxFile(
            {
                "path": path,
                "sha256": hashlib.sha256(content).hexdigest(),
                "network": layout["name"],
                "what": layout["what"],
                "inputs": layout["inputs"],
                "output": layout["output"],
            }
        )
        for path, layout, (_, content) in zip(paths, layouts, files)
    ]
