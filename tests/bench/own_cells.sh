#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Cells of robots drawn at random that are not the same every day: gears that are springs, ripple, friction that warms up
# and sticks, work pieces, coarse encoders, velocities by difference or filtered, stamps that wobble, torques logged late.
# A model is learned from six healthy days of each, knowing l1 alone; six more days and 25 with faults are diagnosed.
# Takes some four minutes a cell on two cores.
# Usage: bash tests/bench/own_cells.sh [CELL...]    springs, pieces, sticky, wobbly, filtered, counts; SEED=N draws other robots
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/own_cells.py "$@"
