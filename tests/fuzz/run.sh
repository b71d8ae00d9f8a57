#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Fuzzes every reader of files from outside with libFuzzer under the address and undefined-behaviour sanitizers.
# Needs clang++ (bash apps/install.sh --checks). What it finds goes to build/fuzz/found/TARGET; make it a seed in
# tests/fuzz/seeds/TARGET, which the ordinary tests feed to every reader.
# Usage: bash tests/fuzz/run.sh [SECONDS [TARGET...]]     SECONDS a target, 30 by default; all targets by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

seconds=${1:-30}
shift || true
all=(csv flog mcap rosbag1 rosbag2 packed npy npz h5 mat robot spec golden labels model network cases)
targets=("${@:-${all[@]}}")

if ! command -v clang++ >/dev/null; then
  echo "fuzz: clang++ is not installed; install it (bash apps/install.sh --checks)" >&2
  exit 2
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)" --target "${targets[@]/#/faultline_fuzz_}"

samples=sample_logs
# Whole files of a kind that the tests have.
whole_files() {
  case $1 in
    csv) ls $samples/bench/*.csv ;;
    flog) ls $samples/rrpr/*.flog ;;
    mcap | rosbag1 | rosbag2) ls tests/formats/cases/"$1"_*/input.* ;;
    packed) ls tests/formats/cases/csv_*/input.* ;;
    robot) ls $samples/*/robot.toml ;;
    spec) ls $samples/*/spec.toml tests/bench/speed/*.toml tests/bench/own/*.toml ;;
    golden) ls $samples/golden/golden.toml $samples/golden/traces/*.csv ;;
    labels) ls $samples/*/labels.csv ;;
    model) ls $samples/golden/model-*.json ;;
    network | npy | npz | h5 | mat) ;;
    cases) ls $samples/golden/cases-*.db ;;
  esac
}

# Into the corpus of a target: its seeds, and whole files, logs and traces cut to their first 8 KiB.
gather() {
  local corpus=$2
  mkdir -p "$corpus"
  if [ -d "tests/fuzz/seeds/$1" ]; then cp -r "tests/fuzz/seeds/$1/." "$corpus"; fi
  whole_files "$1" | while read -r file; do
    local name
    name=$(echo "$file" | tr / _)
    case $file in
      *.csv | *.flog) head -c 8192 "$file" >"$corpus/$name" ;;
      *) cp "$file" "$corpus/$name" ;;
    esac
  done
}

[ -w /dev/shm ] && export TMPDIR=/dev/shm
export ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=0
export UBSAN_OPTIONS=print_stacktrace=1
status=0
for target in "${targets[@]}"; do
  corpus=build/fuzz/corpus/$target found=build/fuzz/found/$target
  gather "$target" "$corpus"
  mkdir -p "$found"
  longest=65536 leaks=1
  [ "$target" = h5 ] && leaks=0  # libhdf5 leaks on damaged files
  [ "$target" = model ] || [ "$target" = cases ] && longest=1000000
  echo "fuzz: $target for $seconds s" >&2
  build/fuzz/tests/fuzz/faultline_fuzz_"$target" "$corpus" -max_total_time="$seconds" -max_len=$longest \
    -detect_leaks=$leaks -timeout=10 -rss_limit_mb=1024 -artifact_prefix="$found/" -print_final_stats=1 2>"$found/log" || {
    status=1
    grep -E "ERROR|SUMMARY|runtime error|what\(\)|Test unit" "$found/log" >&2 || tail -5 "$found/log" >&2
  }
  grep -E "number_of_executed_units|peak_rss_mb" "$found/log" >&2 || true
done
exit $status
