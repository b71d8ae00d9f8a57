#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The regression beside the bank of filters: the living cells and the exact robots, learned from the
# same healthy logs as living.sh and independent_simulation.sh and scored by the same rules.
# Usage: bash tests/bench/explain.sh [CELL or GROUP...]    with the data in $FAULTLINE_SHARED_DATA
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
data=${FAULTLINE_SHARED_DATA:-../shared/data}
out=${FAULTLINE_OUT:-out}/explain
program=${FAULTLINE_EXPLAIN:-build/release/tests/faultline_explain_logs}
if [ ! -x "$program" ]; then
  echo "explain: there is no $program; build it: cmake --build --preset release --target faultline_explain_logs" >&2
  exit 2
fi

chosen() { [ -z "$wanted" ] || [[ " $wanted " == *" $1 "* ]]; }
wanted="$*"

# explain_set NAME L1 TIMING HEALTHY -- LOGS: learns and explains into $out/NAME
explain_set() {
  local dir=$out/$1 l1=$2 timing=$3
  shift 3
  mkdir -p "$dir"
  printf 'axes = "RRP"\n\n[known]\nl1 = %s\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "%s"\n' "$l1" \
    "$timing" >"$dir/robot.toml"
  echo "explaining ${dir##*/}" >&2
  "$program" "$dir/robot.toml" "$dir" "$@" >"$dir/logs.txt"
}

living=$data/living/labels.csv
cells=()
while read -r cell l1; do
  chosen "$cell" || continue
  mapfile -t healthy < <(awk -F, -v c="$cell" '$5 == c && $6 == "learn" {print $1}' "$living" | sed "s|^|$data/living/|")
  mapfile -t logs < <(awk -F, -v c="$cell" '$5 == c && $6 == "test" {print $1}' "$living" | sed "s|^|$data/living/|")
  explain_set "$cell" "$l1" unknown "${healthy[@]}" -- "${logs[@]}"
  cells+=("$out/$cell")
done <<'CELLS'
A 0.35
B 0.25
C 1.0
CELLS
[ ${#cells[@]} -eq 0 ] || python3 tests/bench/living.py "$living" "${cells[@]}"

labels=$data/independent-simulation/labels.csv
while read -r group first last l1 timing; do
  chosen "$group" || continue
  rows() { awk -F, -v a="t_$first.csv" -v b="t_$last.csv" -v none="$1" \
    'NR > 1 && $1 >= a && $1 <= b && ($2 == "none") == none {print $1}' "$labels" | sed "s|^|$data/independent-simulation/|"; }
  mapfile -t healthy < <(rows 1)
  mapfile -t logs < <(rows 0)
  explain_set "$group" "$l1" "$timing" "${healthy[@]}" -- "${logs[@]}"
  python3 tests/bench/explain.py "$labels" "$out/$group"
done <<'GROUPS'
industrial 000 015 0.35 unknown
light 016 031 0.25 unknown
bench_100hz 032 059 1.0 held
bench_73ms 060 070 1.0 held
bench_noisy 071 081 1.0 held
GROUPS
