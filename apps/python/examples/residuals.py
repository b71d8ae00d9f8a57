# SPDX-License-Identifier: MIT
"""From a frame to a picture of residuals: residuals.py LOG MODEL CASES PICTURE.png

The log is read into arrays, as a notebook would have it already, diagnosed from there, and the residuals of
its joints are drawn with the faults that were found.
"""
import sys

import faultline


def draw(diagnosis, picture):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    curves = diagnosis.curves(bins=500)
    joints = len(curves.healthy_residual)
    figure, axes = pyplot.subplots(joints, 1, sharex=True, figsize=(8, 1 + 1.6 * joints), squeeze=False)
    for j, axis in enumerate(axes[:, 0], 1):
        axis.plot(curves.whole["t_residual"], curves.whole[f"residual{j}"], color="0.25", linewidth=1)
        axis.axhline(
            curves.healthy_residual[j - 1], color="tab:green", linewidth=1, label="largest when healthy"
        )
        for fault in diagnosis.faults:
            if fault.joint in (j, None):
                axis.axvspan(fault.onset_s, fault.end_s or diagnosis.log.end_s, color="tab:red", alpha=0.15)
                axis.axvline(fault.onset_s, color="tab:red", label=fault.kind.replace("_", " "))
        axis.set_ylabel(f"joint {j}")
        axis.set_yscale("log")
        axis.legend(loc="upper left", fontsize="small")
    axes[-1, 0].set_xlabel("time, s")
    figure.suptitle(diagnosis.sentence)
    figure.supylabel("velocity residual, 1 = usual when healthy")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main(log, model, cases, picture):
    columns = faultline.open_log(log).to_dict()
    diagnosis = faultline.load_model(model, cases=cases).diagnose(columns)
    print(diagnosis.sentence)
    try:
        draw(diagnosis, picture)
    except ImportError as missing:
        print(f"no picture: {missing}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
