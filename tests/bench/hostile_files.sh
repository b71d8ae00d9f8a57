#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Small files that ask for much memory or time: no one below 2 MB may take more than 300 MB or 10 s of processor time in
# inspect, convert and diagnose. Places and sizes are drawn by SEED. Takes some ten minutes; needs python3, zstd, lz4.
# Usage: bash tests/bench/hostile_files.sh [SEED] [WORD...]: only files whose names hold one of the words
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
seed=${1:-1}
out=$FAULTLINE_OUT/hostile
mkdir -p "$out"
samples=sample_logs/bench
[ -e "$out/bench.json" ] || "$FAULTLINE" learn $samples/healthy_*.csv --robot $samples/robot.toml \
  -o "$out/bench.json" >"$out/bench.txt"
if [ ! -e "$out/seed_$seed/.whole" ]; then
  python3 tests/bench/hostile_inputs.py "$out/seed_$seed" "$seed"
  touch "$out/seed_$seed/.whole"
fi
python3 tests/bench/hostile_files.py "$FAULTLINE" "$out/seed_$seed" "$out/bench.json" "${@:2}"
