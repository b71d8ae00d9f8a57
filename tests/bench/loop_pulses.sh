#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A commanded torque that the controller's own law did not ask for: simulated position loops of a linear axis with pulses
# added inside the loop, and the second half of a real axis' log with pulses added to the logged command by hand (which is
# then wrong, while the axis moves as it did). Control laws are learned, gains are not given.
# Usage: bash tests/bench/loop_pulses.sh    with the real log in $FAULTLINE_SHARED_DATA; takes some minutes on two cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/loop_pulses.py "${FAULTLINE_SHARED_DATA:-../shared/data}/emps/DATA_EMPS.csv"
