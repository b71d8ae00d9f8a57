#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A grave fault after another fault, one that comes twice or is gone for a while, two at once: simulated at 500 Hz, diagnosed with a model
# of three healthy logs. Takes two minutes on two cores.
# Usage: bash tests/bench/faults_in_sequence.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/faults_in_sequence.py "$@"
