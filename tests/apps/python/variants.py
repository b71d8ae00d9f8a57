# SPDX-License-Identifier: MIT
"""The sample model with networks of other kinds than `learn` makes of it, of random weights."""
import json

import numpy

from support import MODEL, program

JOINTS = 3
HIDDEN = 11


def _random(generator, *shape):
    return generator.uniform(-1, 1, shape).tolist()


def _mlp(generator, inputs, outputs, kind):
    sizes = [inputs, HIDDEN, HIDDEN, outputs]
    layers = [
        {"weights": _random(generator, wide, narrow), "bias": _random(generator, wide)}
        for narrow, wide in zip(sizes, sizes[1:])
    ]
    return {"hidden": "tanh", "output": kind, "layers": layers}


def _scaler(generator, size):
    return {
        "offset": _random(generator, size),
        "factor": (numpy.exp(generator.uniform(-2, 2, size))).tolist(),
    }


def _residual(members, kind, target, turns, mean_torque):
    generator = numpy.random.default_rng(sum(turns))
    inputs = (4 if mean_torque else 3) * JOINTS + sum(turns)
    members["residual"].update(
        kind=kind,
        target=target,
        turns=turns,
        uses_mean_torque=mean_torque,
        inputs=_scaler(generator, inputs),
        outputs=_scaler(generator, 2 * JOINTS),
        mlp=_mlp(generator, inputs, 2 * JOINTS, "linear"),
    )


def _samples(members, features, kind):
    generator = numpy.random.default_rng(len(features))
    part = members["samples"]["classifier"]
    inputs, outputs = (1 if features == "velocity" else 3) * JOINTS, len(part["classes"])
    part.update(
        features=features,
        scaler=_scaler(generator, inputs),
        mlp=_mlp(generator, inputs, outputs, kind),
        rbfn={
            "centres": _random(generator, inputs, HIDDEN),
            "inverse_radii": generator.uniform(0.1, 1, (inputs, HIDDEN)).tolist(),
            "weights": _random(generator, outputs, HIDDEN),
            "bias": _random(generator, outputs),
        },
    )


VARIANTS = {
    "turning": lambda members: _residual(members, "mlp", "change", [True, False, True], False),
    "state": lambda members: _residual(members, "mlp", "state", [False, False, False], True),
    "hybrid": lambda members: _residual(members, "hybrid", "change", [True, True, False], True),
    "velocity": lambda members: _samples(members, "velocity", "linear"),
    "hypotheses": lambda members: _samples(members, "hypotheses", "logistic"),
    "torque_space": lambda members: _samples(members, "torque_space", "softmax"),
}


def varied_model(path, change):
    """Writes and signs the model with the change made; its path and members."""
    members = json.loads(MODEL.read_text())
    change(members)
    path.write_text(json.dumps(members))
    program("model", "sign", path, "--why", "networks of another kind")
    return path, members
