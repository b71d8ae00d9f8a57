#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A real arm with six axes and a coupled wrist, the Staubli TX40 of the shared data: its recording is cut into four
# pieces of 1.85 s at 1 kHz, a robot is learned from all of them (5.5 s are too few for its 40 base parameters, so none is
# held out), and each piece is diagnosed as it is and with faults written into it. Needs numpy and scipy; takes some three
# minutes on two cores.
# Usage: bash tests/bench/tx40_faults.sh     with the data in $FAULTLINE_SHARED_DATA
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/tx40_faults.py "${FAULTLINE_SHARED_DATA:-../shared/data}/staubli-tx40"
