#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A healthy robot that is not quite the one that was learned from: friction, masses, noise, clocks. A model is
# learned from three exact healthy logs with the default [normal]; then each difference is simulated with several seeds,
# healthy and with faults inside, and diagnosed. Goal: no alarm in the healthy logs, 95 % found and 88 % right in the
# others. Takes some minutes on two cores.
# Usage: bash tests/bench/healthy_but_different.sh [ROW...]    ROW as the table names it, all by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/healthy_but_different.py "$@"
