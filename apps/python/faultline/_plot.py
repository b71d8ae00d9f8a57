# SPDX-License-Identifier: MIT
"""A picture of a diagnosis, by matplotlib."""
import io
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._diagnosis import Curves, Diagnosis

INCH_PER_JOINT, WIDTH_INCH, EXTRA_INCH, DPI = 1.6, 8.0, 1.2, 100


def figure_of(diagnosis: "Diagnosis", curves: "Curves") -> Any:
    """A matplotlib Figure: the residual of each joint over time, with the faults as bands. It belongs to no
    window, so that nothing has to be closed; a notebook shows it. Raises ImportError without matplotlib."""
    from matplotlib.figure import Figure

    class Picture(Figure):
        def _repr_png_(self) -> bytes:
            png = io.BytesIO()
            self.savefig(png, format="png", dpi=DPI)
            return png.getvalue()

    joints = len(curves.healthy_residual)
    figure = Picture(figsize=(WIDTH_INCH, EXTRA_INCH + INCH_PER_JOINT * joints), layout="constrained")
    figure.suptitle(diagnosis.sentence, wrap=True)
    if joints == 0:
        return figure
    axes = figure.subplots(joints, 1, sharex=True, squeeze=False)[:, 0]
    for number, axis in enumerate(axes, 1):
        if f"residual{number}" in curves.whole:
            axis.plot(
                curves.whole["t_residual"], curves.whole[f"residual{number}"], color="0.25", linewidth=1
            )
            axis.set_yscale("log")
        axis.axhline(
            curves.healthy_residual[number - 1], color="tab:green", linewidth=1, label="largest when healthy"
        )
        for fault in diagnosis.faults:
            if fault.joint in (number, None) and fault.onset_s is not None:
                end = diagnosis.log.end_s if fault.end_s is None else fault.end_s
                axis.axvspan(fault.onset_s, end, color="tab:red", alpha=0.15)
                axis.axvline(fault.onset_s, color="tab:red", label=fault.kind.replace("_", " "))
        axis.set_ylabel(f"joint {number}")
        axis.legend(loc="upper left", fontsize="small")
    axes[-1].set_xlabel("time, s")
    what = "position" if curves.by_reference else "velocity"
    figure.supylabel(f"{what} residual, 1 = usual when healthy")
    return figure
