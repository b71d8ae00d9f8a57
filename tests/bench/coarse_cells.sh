#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cells whose logs are coarse: encoders of 16 bits, velocities that are differences, stamps in whole milliseconds that
# wobble, rows lost, friction and torque constants of other days. A model is learned from six healthy days of each; six
# more and 50 with faults are diagnosed. Takes some ten minutes on two cores.
# Usage: bash tests/bench/coarse_cells.sh [steady|fast_control]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/coarse_cells.py "$@"
