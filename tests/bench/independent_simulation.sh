#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The judge: logs of another simulator, five groups of one robot, rate and noise each. A model is learned from the
# fault-free logs of a group alone, with no more than the first length known, and diagnoses all logs of the group.
# Usage: bash tests/bench/independent_simulation.sh [GROUP...]    with the data in $FAULTLINE_SHARED_DATA
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
data=${FAULTLINE_SHARED_DATA:-../shared/data}/independent-simulation
out=out/independent-simulation
. tests/bench/study.sh

# group, its first and last log, l1 in m, what the torque does between samples
groups="\
industrial 000 015 0.35 unknown
light      016 031 0.25 unknown
bench_100hz 032 059 1.0 held
bench_73ms 060 070 1.0 held
bench_noisy 071 081 1.0 held"

chosen=()
while read -r group first last l1 between; do
  [ $# -eq 0 ] || [[ " $* " == *" $group "* ]] || continue
  dir=$out/$group
  rm -rf "$dir" && mkdir -p "$dir"
  printf 'axes = "RRP"\n\n[known]\nl1 = %s\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "%s"\n' \
    "$l1" "$between" >"$dir/robot.toml"
  awk -F, -v first="t_$first.csv" -v last="t_$last.csv" 'NR == 1 || ($1 >= first && $1 <= last)' \
    "$data/labels.csv" >"$dir/labels.csv"
  study_group "$dir" "$data"
  chosen+=("$dir")
done <<<"$groups"
python3 tests/bench/score.py "${chosen[@]}"
