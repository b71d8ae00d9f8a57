#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Hours of healthy logs, ten minutes each and each of another day (friction .8 to 1.25, torque constants 1.5 %, noise .8
# to 1.3), by a model learned from six days of ten seconds: false alarms. Then one log of an hour at 1 kHz, healthy and with a
# fault all the time: time and memory. About three minutes an hour of logs at 1 kHz.
# Usage: bash tests/bench/healthy_hours.sh [HOURS [RATE...]]    RATE of 1000, 500, 100 (Hz); 1 hour each by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/healthy_hours.py "${1:-1}" "${@:2}"
