#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Kills a batch 100 times at random (SIGKILL), each time somewhere between its start and its usual end, runs it again
# until it is done, and compares all bytes with those of an undisturbed run. A new folder begins whenever one is done.
# Usage: bash tests/bench/batch_kills.sh [KILLS] [SEED]     100 and 1 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
kills=${1:-100}
RANDOM=${2:-1}
faultline=build/release/faultline
threads=2
out=out/batch-kills
[ -x "$faultline" ] || cmake --build --preset release --target faultline >/dev/null
mkdir -p "$out"
[ -f "$out/model.json" ] ||
  "$faultline" learn sample_logs/bench/healthy_*.csv --robot sample_logs/bench/robot.toml -o "$out/model.json" >/dev/null
rm -rf "$out"/whole "$out"/killed "$out"/logs
for day in 1 2 3 4; do
  mkdir -p "$out/logs/day_$day"
  cp sample_logs/bench/*.csv "$out/logs/day_$day"
done
echo "no,log" >"$out/logs/bad.csv"

batch() { "$faultline" batch "$out/logs" --model "$out/model.json" -o "$1" --html --threads $threads >/dev/null 2>"$out/err" || [ $? -eq 3 ]; }
now_ms() { date +%s%3N; }

start=$(now_ms)
batch "$out/whole"
whole_ms=$(($(now_ms) - start))
logs=$(wc -l <"$out/whole/index.ndjson")

killed=0 finished=0
while [ "$killed" -lt "$kills" ]; do
  rm -rf "$out/killed"
  for _ in $(seq 1000); do
    [ "$killed" -lt "$kills" ] || break
    "$faultline" batch "$out/logs" --model "$out/model.json" -o "$out/killed" --html --threads $threads >/dev/null 2>&1 &
    job=$!
    sleep "$(awk -v m=$whole_ms -v r=$RANDOM 'BEGIN {printf "%.3f", m / 1000 * r / 32768 / 3}')"
    kill -9 $job 2>/dev/null && killed=$((killed + 1))
    wait $job 2>/dev/null || true
    [ ! -f "$out/killed/.batch/finished.json" ] || break
  done
  batch "$out/killed"
  diff -r -x known_logs "$out/whole" "$out/killed" >"$out/diff" || {
    echo "after $killed kills the results differ: see $out/diff"
    exit 1
  }
  finished=$((finished + 1))
done
echo "$killed kills, $finished folders of $logs logs finished: every byte as in the undisturbed run ($whole_ms ms)"
