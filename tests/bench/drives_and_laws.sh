#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Drives, torque sensors and control laws that are wrong, alone and before a mechanical fault, on two robots whose logs hold
# commanded torque, measured torque and references. The robots lie outside the model: Stribeck friction, lag and ripple of
# the drives, quantised signals, days that differ. Takes some five minutes.
# Usage: bash tests/bench/drives_and_laws.sh [SEED...]     801 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/drives_and_laws.py "$@"
