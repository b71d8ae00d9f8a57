# SPDX-License-Identifier: MIT
"""What the operators of the exported graphs mean, in NumPy: there is no runtime of ONNX in Debian."""
import numpy
import onnx
from onnx import numpy_helper


def softmax(values, axis):
    powers = numpy.exp(values - values.max(axis=axis, keepdims=True))
    return powers / powers.sum(axis=axis, keepdims=True)


OPERATORS = {
    "Abs": numpy.abs,
    "Add": numpy.add,
    "Clip": numpy.clip,
    "Concat": lambda *parts, axis: numpy.concatenate(parts, axis=axis),
    "Div": numpy.divide,
    "Gather": lambda values, which, axis: numpy.take(values, which, axis=axis),
    "Identity": lambda values: values,
    "Log": numpy.log,
    "MatMul": numpy.matmul,
    "Mul": numpy.multiply,
    "ReduceSum": lambda values, axes, keepdims: values.sum(axis=tuple(axes), keepdims=bool(keepdims)),
    "Reciprocal": numpy.reciprocal,
    "Sigmoid": lambda values: 1.0 / (1.0 + numpy.exp(-values)),
    "Sign": numpy.sign,
    "Sin": numpy.sin,
    "Softmax": softmax,
    "Sqrt": numpy.sqrt,
    "Sub": numpy.subtract,
    "Tanh": numpy.tanh,
    "Unsqueeze": lambda values, axes: numpy.expand_dims(values, tuple(axes)),
}


def values_of(model, inputs, real=numpy.float64):
    """Every value of a graph by name, for inputs by name, with all real numbers of one type."""
    graph = model.graph
    if set(inputs) != {port.name for port in graph.input}:
        raise AssertionError(f"{set(inputs)} are not the inputs of the graph")
    values = {one.name: numpy_helper.to_array(one) for one in graph.initializer}
    values.update(inputs)
    for name, value in values.items():
        values[name] = value.astype(real) if value.dtype == numpy.float64 else value
    for node in graph.node:
        attributes = {one.name: onnx.helper.get_attribute_value(one) for one in node.attribute}
        (result,) = node.output
        values[result] = OPERATORS[node.op_type](*(values[name] for name in node.input), **attributes)
        if values[result].dtype != real:
            raise AssertionError(f"{result} is {values[result].dtype}")
    return values


def run(model, inputs, real=numpy.float64):
    """The one output of a graph."""
    (output,) = model.graph.output
    return values_of(model, inputs, real)[output.name]


def magnitudes(model, inputs):
    """What the rounding of each output is a share of: the sum of the magnitudes that it is the sum of, and of a
    probability itself."""
    values = values_of(model, inputs)
    nodes = list(model.graph.node)
    last = max(number for number, node in enumerate(nodes) if node.op_type == "MatMul")
    factors, weights = (numpy.abs(values[name]) for name in nodes[last].input)
    sums = factors @ weights
    for node in nodes[last + 1 :]:
        if node.op_type in ("Softmax", "Sigmoid"):
            sums = values[node.output[0]]
        elif node.op_type == "Div":
            sums = sums / numpy.abs(values[node.input[1]])
        elif node.op_type in ("Add", "Sub"):
            sums = sums + numpy.abs(values[node.input[1]])
        elif node.op_type != "Identity":
            raise AssertionError(f"{node.op_type} behind the last layer")
    return sums
