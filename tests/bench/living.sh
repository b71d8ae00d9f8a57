#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Robots that are not the same every day: three cells of six healthy days each to learn from, nothing else known
# but l1, then healthy and faulty days to judge.
# Usage: bash tests/bench/living.sh [CELL...]    with the data in $FAULTLINE_SHARED_DATA
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
data=${FAULTLINE_SHARED_DATA:-../shared/data}/living
out=${FAULTLINE_OUT:-out}/living
faultline=${FAULTLINE:-build/release/faultline}
if [ ! -x "$faultline" ]; then
  echo "living: there is no $faultline; build it, or name it in FAULTLINE" >&2
  exit 2
fi

# files CELL USE: the logs of that cell and use
files() { awk -F, -v cell="$1" -v use="$2" 'NR > 1 && $5 == cell && $6 == use {print $1}' "$data/labels.csv"; }

chosen=()
while read -r cell l1; do
  [ $# -eq 0 ] || [[ " $* " == *" $cell "* ]] || continue
  dir=$out/$cell
  mkdir -p "$dir/reports"
  printf 'axes = "RRP"\n\n[known]\nl1 = %s\n\n[log]\ntorque = "commanded"\n' "$l1" >"$dir/robot.toml"
  mapfile -t healthy < <(files "$cell" learn | sed "s|^|$data/|")
  echo "learning cell $cell from ${#healthy[@]} logs" >&2
  start=$(date +%s.%N)
  "$faultline" learn "${healthy[@]}" --robot "$dir/robot.toml" -o "$dir/model.json" >"$dir/learn.txt"
  awk -v from="$start" -v to="$(date +%s.%N)" 'BEGIN {print to - from}' >"$dir/learn_s"
  for file in $(files "$cell" test); do
    status=0
    "$faultline" diagnose "$data/$file" --model "$dir/model.json" --json "$dir/reports/$file.json" \
      >"$dir/reports/$file.txt" || status=$?
    [ "$status" -le 1 ] || exit "$status"
  done
  chosen+=("$dir")
done <<'CELLS'
A 0.35
B 0.25
C 1.0
CELLS
python3 tests/bench/living.py "$data/labels.csv" "${chosen[@]}"
