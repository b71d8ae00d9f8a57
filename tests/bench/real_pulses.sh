#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Pulses of torque on real arms that the controller did not ask for: acrobot and pendubot, learned from their
# undisturbed runs with the torque that was commanded, and each undisturbed run judged by a model learned without it.
# Usage: bash tests/bench/real_pulses.sh [ROBOT...]    with the data in $FAULTLINE_SHARED_DATA
#   ROBOT is acrobot or pendubot; both by default. A learn a log: takes some ten minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/real_pulses.py "${FAULTLINE_SHARED_DATA:-../shared/data}/double-pendulum" "$@"
