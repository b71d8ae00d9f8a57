#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Robots without torque: joints of simulated steppers that stall, lose steps, drag or slip, and two logs of a real SCARA
# with steppers, a part of each to learn from and stalls put into the rest by hand. Nothing but references is known.
# Usage: bash tests/bench/stalls.sh    with the real logs in $FAULTLINE_SHARED_DATA; takes a minute on two cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/stalls.py "${FAULTLINE_SHARED_DATA:-../shared/data}/bioscara"
