#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The smallest fault that a model says it finds nine times of ten, checked: robots drawn at random whose days differ
# (SEED=2 draws others) get faults of a half, once and twice that size. Takes some ten minutes on two cores.
# Usage: [SEED=N] bash tests/bench/least_found.sh [CELL...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/least_found.py "$@"
