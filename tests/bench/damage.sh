#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Flips single bits of, and cuts, each kind of file that the program reads: what is refused, what is read with
# a word about it, what changes a result in silence. Learns a model of the bench robot unless there is one.
# Usage: bash tests/bench/damage.sh [COUNT] [SEED] [KIND...]
#   COUNT flips and COUNT cuts of each kind, 500 by default; the slow kinds get a part, as the table tells
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
out=$FAULTLINE_OUT/damage
mkdir -p "$out"
samples=sample_logs/bench
[ -e "$out/bench.json" ] || "$FAULTLINE" learn $samples/healthy_*.csv --robot $samples/robot.toml \
  -o "$out/bench.json" >"$out/bench.txt"
exec "${PYTHON:-python3}" tests/bench/damage.py "$FAULTLINE" "$out" "$@"
