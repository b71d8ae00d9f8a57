#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Faults that no hypothesis describes (a drive that clips, vibration, a worn spot, drop-outs, noise), friction
# that creeps, known faults and pushes of several lengths, on a SCARA of this script's own equations whose
# friction differs from day to day. A model is learned from three healthy days. Goal: what is unknown is called
# so, what is known keeps its name. Takes some minutes.
# Usage: bash tests/bench/unknown_faults.sh    needs numpy
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-python3}" tests/bench/unknown_faults.py
