# SPDX-License-Identifier: MIT
"""Graphs of ONNX: what the networks need of it, in float64, of operators that ONNX Runtime lists in
float64 for the processor.

Every value is a matrix with a row a sample; vectors hold a number a column.
"""
import struct
from typing import Any, Dict, List, Mapping, Sequence

from .errors import UsageError

OPSET = 15
IR_VERSION = 8
BATCH = "samples"


def onnx_module() -> Any:
    """The package onnx; raises faultline.UsageError when it is not there."""
    try:
        import onnx
        import onnx.helper
    except ImportError as error:
        raise UsageError(
            "to_onnx", f"needs ONNX for Python ({error}); install it: apt-get install python3-onnx"
        ) from error
    return onnx


class Graph:
    """A graph that is being built. Values go by name; each method gives the name of what it computes."""

    def __init__(self) -> None:
        self._onnx = onnx_module()
        self._nodes: List[Any] = []
        self._constants: List[Any] = []
        self._by_content: Dict[Any, str] = {}

    def _constant(self, name: str, kind: str, shape: Sequence[int], values: Sequence[float]) -> str:
        packed = struct.pack(f"<{len(values)}{kind}", *values)
        key = (kind, tuple(shape), packed)
        if key not in self._by_content:
            types = self._onnx.TensorProto
            element = types.DOUBLE if kind == "d" else types.INT64
            unique = f"{name}_{len(self._constants)}"
            self._constants.append(self._onnx.helper.make_tensor(unique, element, shape, packed, raw=True))
            self._by_content[key] = unique
        return self._by_content[key]

    def vector(self, name: str, values: Sequence[float]) -> str:
        """A number a column."""
        return self._constant(name, "d", [1, len(values)], values)

    def scalar(self, name: str, value: float) -> str:
        """One number for all columns."""
        return self._constant(name, "d", [], [value])

    def matrix(self, name: str, rows: Sequence[Sequence[float]]) -> str:
        """Rows of equal length."""
        return self._constant(name, "d", [len(rows), len(rows[0])], [value for row in rows for value in row])

    def op(self, kind: str, *inputs: str, **attributes: Any) -> str:
        """One operator; its result is called by the kind and a number."""
        result = f"{kind.lower()}_{len(self._nodes)}"
        self._nodes.append(
            self._onnx.helper.make_node(kind, list(inputs), [result], name=result, **attributes)
        )
        return result

    def columns(self, values: str, which: Sequence[int]) -> str:
        """The columns that are named by number, from 0."""
        return self.op("Gather", values, self._constant("columns", "q", [len(which)], which), axis=1)

    def beside(self, *parts: str) -> str:
        """The columns of all parts."""
        return parts[0] if len(parts) == 1 else self.op("Concat", *parts, axis=1)

    def cosine(self, angle: str) -> str:
        """By 1 - 2 sin^2(angle / 2): runtimes know Cos in float32 only."""
        sine = self.op("Sin", self.op("Mul", angle, self.scalar("half", 0.5)))
        return self.op(
            "Sub", self.scalar("one", 1.0), self.op("Mul", self.scalar("two", 2.0), self.op("Mul", sine, sine))
        )

    def asinh_of_magnitude(self, values: str) -> str:
        """asinh |x| = ln(|x| + sqrt(x^2 + 1)): runtimes know Asinh in float32 only."""
        size = self.op("Abs", values)
        root = self.op("Sqrt", self.op("Add", self.op("Mul", size, size), self.scalar("one", 1.0)))
        return self.op("Log", self.op("Add", size, root))

    def asinh(self, values: str) -> str:
        """Of numbers of either sign."""
        return self.op("Mul", self.op("Sign", values), self.asinh_of_magnitude(values))

    def clipped(self, values: str, most: float) -> str:
        """Between -most and most."""
        return self.op("Clip", values, self.scalar("least", -most), self.scalar("most", most))

    def scaled(self, values: str, scaler: Mapping[str, Any]) -> str:
        """(values - offset) * factor"""
        moved = self.op("Sub", values, self.vector("offset", scaler["offset"]))
        return self.op("Mul", moved, self.vector("factor", scaler["factor"]))

    def unscaled(self, values: str, scaler: Mapping[str, Any]) -> str:
        """values / factor + offset"""
        spread = self.op("Div", values, self.vector("output_factor", scaler["factor"]))
        return self.op("Add", spread, self.vector("output_offset", scaler["offset"]))

    def affine(self, values: str, weights: Sequence[Sequence[float]], bias: Sequence[float]) -> str:
        """Weights of outputs x inputs. The bias is taken away with its sign turned: runtimes fuse a product, a
        sum and a tanh into an operator that some of them have in float32 only."""
        product = self.op("MatMul", values, self.matrix("weights", list(zip(*weights))))
        return self.op("Sub", product, self.vector("minus_bias", [-value for value in bias]))

    def mlp(self, values: str, mlp: Mapping[str, Any]) -> str:
        """A network of the model file, without its scalers."""
        last = len(mlp["layers"]) - 1
        for number, layer in enumerate(mlp["layers"]):
            values = self.affine(values, layer["weights"], layer["bias"])
            if number < last:
                values = self.op("Tanh", values)
        if mlp["output"] == "softmax":
            return self.op("Softmax", values, axis=1)
        return self.op("Sigmoid", values) if mlp["output"] == "logistic" else values

    def rbfn(self, values: str, rbfn: Mapping[str, Any]) -> str:
        """The same of the other kind: Cauchy units 1 / (1 + |R^-1 (x - mu)|^2) and a weighted sum. Distances
        are of differences, not of the expanded square, which would cancel."""
        inputs, units = len(rbfn["centres"]), len(rbfn["centres"][0])
        each = [
            self._constant(
                name, "d", [1, units, inputs], [rbfn[name][i][u] for u in range(units) for i in range(inputs)]
            )
            for name in ("centres", "inverse_radii")
        ]
        axis = self._constant("axis", "q", [1], [1])
        apart = self.op("Mul", self.op("Sub", self.op("Unsqueeze", values, axis), each[0]), each[1])
        last = self._constant("axis", "q", [1], [2])
        squares = self.op("ReduceSum", self.op("Mul", apart, apart), last, keepdims=0)
        near = self.op("Reciprocal", self.op("Add", squares, self.scalar("one", 1.0)))
        return self.affine(near, rbfn["weights"], rbfn["bias"])

    def to_bytes(
        self, layout: Mapping[str, Any], result: str, document: str, properties: Mapping[str, str], version: str
    ) -> bytes:
        """The file of a network whose inputs and output are those of the layout; `result` is the output."""
        helper = self._onnx.helper
        output = layout["output"]
        self._nodes.append(helper.make_node("Identity", [result], [output["name"]], name=output["name"]))
        graph = helper.make_graph(
            self._nodes,
            layout["name"],
            [self._port(port) for port in layout["inputs"]],
            [self._port(output)],
            self._constants,
            document,
        )
        model = helper.make_model(
            graph,
            producer_name="faultline",
            producer_version=version,
            doc_string=document,
            opset_imports=[helper.make_opsetid("", OPSET)],
            ir_version=IR_VERSION,
        )
        helper.set_model_props(model, dict(properties))
        self._onnx.checker.check_model(model, full_check=True)
        return model.SerializeToString(deterministic=True)

    def _port(self, port: Mapping[str, Any]) -> Any:
        names = ", ".join(
            name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(port["columns"], port["units"])
        )
        return self._onnx.helper.make_tensor_value_info(
            port["name"],
            self._onnx.TensorProto.DOUBLE,
            [BATCH, len(port["columns"])],
            f"{port['what']}; columns: {names}",
        )
