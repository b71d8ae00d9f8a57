# SPDX-License-Identifier: MIT
"""Writes networks as ONNX with inputs and the outputs faultline gives, for onnx_runtime.cjs to compare."""
import json
import pathlib
import sys

import numpy

import faultline
from random_rows import random_inputs
from support import CASES, LOGS, MODEL
from variants import VARIANTS, varied_model


def stacked(model, network, members, layout, generator):
    """Rows of every sample log, then rows at random."""
    parts = [model.network_inputs(network, log) for log in sorted(LOGS.glob("*.csv"))]
    parts.append(random_inputs(network, layout, members, generator))
    return {name: numpy.concatenate([part[name] for part in parts]) for name in parts[0]}


def write_model(folder, name, model, members, generator):
    cases = []
    for one in model.to_onnx(folder / name):
        inputs = stacked(model, one.network, members, one.inputs, generator)
        arrays = {**inputs, one.output.name: model.network_outputs(one.network, inputs)}
        for array_name, values in arrays.items():
            values.astype("<f8").tofile(folder / name / f"{one.network}.{array_name}.f64")
        shapes = {array_name: values.shape for array_name, values in arrays.items()}
        cases.append({"model": name, "network": one.network, "output": one.output.name, "shapes": shapes})
    return cases


def main(folder):
    generator = numpy.random.default_rng(11)
    members = json.loads(MODEL.read_text())
    cases = write_model(folder, "sample", faultline.load_model(MODEL, cases=CASES), members, generator)
    for name, change in VARIANTS.items():
        path, members = varied_model(folder / f"{name}.json", change)
        cases += write_model(folder, name, faultline.load_model(path, cases=CASES), members, generator)
    (folder / "cases.json").write_text(json.dumps(cases))


main(pathlib.Path(sys.argv[1]))
