#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Healthy days that differ from the learned ones, on three robots that are simulated by equations of their own: a SCARA,
# a vertical arm of two joints and a gantry with a turning wrist. Each is learned from four days that are alike; then
# each condition is simulated with four healthy days and two with a fault, and diagnosed. Takes some 80 s on two cores.
# Usage: bash tests/bench/healthy_days.sh [NAME...]    robots and conditions as the table names them, all by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/healthy_days.py "$@"
