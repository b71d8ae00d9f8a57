# SPDX-License-Identifier: MIT
"""Rows at random for the networks of a model."""
import numpy

ROWS = 3000


def random_inputs(network, layout, model, generator):
    """Inputs as training saw them and half as far again, SI units."""
    if network == "residual_mlp":
        healthy = [model["residual"]["inputs"][part] for part in ("offset", "factor")]
        joints = len(model["residual"]["turns"])
        shape = (ROWS, len(layout) * joints)
        spread = 1.5 * generator.uniform(-1, 1, shape)
        made = healthy[0][: shape[1]] + spread / healthy[1][: shape[1]]
        return {port.name: made[:, i * joints : (i + 1) * joints].copy() for i, port in enumerate(layout)}
    if network.startswith("evidence"):
        scaler = model["judges"]["scaler"]
        made = generator.standard_normal((ROWS, len(scaler["offset"])))
        return {"features": scaler["offset"] + 1.5 * made / scaler["factor"]}
    rms = numpy.array(model["samples"]["classifier"]["torque_rms"])
    return {
        port.name: generator.choice([-1, 1], (ROWS, len(rms)))
        * (1.0 if port.name == "velocity_residual" else rms)
        * numpy.exp(generator.uniform(-9, 7, (ROWS, len(rms))))
        for port in layout
    }
