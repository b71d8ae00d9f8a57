#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Three living cells on equations of their own, none of faultline's: gear springs of 15000 N m/rad, 1.5 % ripple, and a
# work piece and warmth (loaded), coarse codes, late stamps and lost rows (coarse), slow logs of late torques (slow). A
# model is learned from six days of each; 12 more, 27 with faults and three with unknown ones are diagnosed.
# Usage: bash tests/bench/strong_living.sh [CELL...]    loaded, coarse, slow; SEED=N draws other robots
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/strong_living.py "$@"
