# SPDX-License-Identifier: MIT
"""From a frame to a picture of residuals: residuals.py LOG MODEL CASES PICTURE.png

The log is read into arrays, as a notebook would have it already, diagnosed from there, and the residuals of
its joints are drawn with the faults that were found.
"""
import sys

import faultline


def main(log, model, cases, picture):
    columns = faultline.open_log(log).to_dict()
    diagnosis = faultline.load_model(model, cases=cases).diagnose(columns)
    print(diagnosis.sentence)
    try:
        diagnosis.plot().savefig(picture)
    except ImportError as missing:
        print(f"no picture: {missing}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
