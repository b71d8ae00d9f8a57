#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A real arm with six axes and a coupled wrist, the Staubli TX40 of the shared data: its recording is cut into four
# pieces of 1.85 s at 1 kHz, and each piece, as it is and with faults written into it, is diagnosed with a robot learned
# from the other three. Needs numpy and scipy; takes some ten minutes on two cores.
# Usage: bash tests/bench/tx40_faults.sh     with the data in $FAULTLINE_SHARED_DATA
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/tx40_faults.py "${FAULTLINE_SHARED_DATA:-../shared/data}/staubli-tx40"
