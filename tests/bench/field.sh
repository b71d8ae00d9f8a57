#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The figures of the field: AUROC, delay and false alarms an hour of the program and of five peers (momentum observer,
# tracking error, Mahalanobis distance, IsolationForest, one-class SVM) that learn from the same healthy logs: three
# cells of living robots, a real arm with six axes, and a simulated joint at constant speed. Needs numpy; two peers need
# scikit-learn and are left out without it. Takes about half an hour on two cores; with KEEP=1 models of an earlier run
# are used again, and NUMBERS="1 6" names the numbers of healthy logs of the curve.
# Usage: bash tests/bench/field.sh [GROUP...]     with the data in $FAULTLINE_SHARED_DATA; a group is the begin of its
#        name, such as "living A", doosan or "constant speed"
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-/usr/bin/python3}" tests/bench/field.py "${FAULTLINE_SHARED_DATA:-../shared/data}" "$@"
