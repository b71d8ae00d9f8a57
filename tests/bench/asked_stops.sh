#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How diagnose --at dates the first sign before a stop: on the faulty sample logs, cut to 5 s before a moment after the
# onset, with a robot that stands for 1 s behind it, and on healthy simulated logs. Takes a few minutes.
# Usage: bash tests/bench/asked_stops.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-/usr/bin/python3}" tests/bench/asked_stops.py
