#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Logs of 10, 14 and 20 rows a second, which are explained by one-step predictions: RRP robots drawn at random
# (SEED=2 draws others) whose masses, friction and controller differ by day. A model is learned from five
# healthy days of each; eight more and 56 with faults are diagnosed. Takes some five minutes on two cores.
# Usage: [SEED=N] bash tests/bench/slow_logs.sh [PERIOD_S...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/slow_logs.py "$@"
