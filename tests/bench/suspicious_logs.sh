#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Faulty logs given to learn() as healthy: each faulty sample log with two healthy ones, and of robots that are not the
# same every day five healthy days with a faulty one. Then healthy days alone: none is to be left out.
# Usage: bash tests/bench/suspicious_logs.sh    with the data in $FAULTLINE_SHARED_DATA, if any; BUILD is the build folder
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
data=${FAULTLINE_SHARED_DATA:-../shared/data}/living
out=${FAULTLINE_OUT:-out}/suspicious
judge=${BUILD:-build/release}/tests/faultline_suspicious_logs
if [ ! -x "$judge" ]; then
  echo "suspicious_logs: there is no $judge; build it with cmake --build, target faultline_suspicious_logs" >&2
  exit 2
fi
mkdir -p "$out"
asked=0 found=0 refused=0 wronged=0

# one ROBOT FAULTY|- HEALTHY...: FAULTY (if any) among the healthy ones
one() {
  local robot=$1 faulty=$2 result
  shift 2
  local logs=("$@")
  [ "$faulty" = - ] || logs+=("$faulty")
  result=$("$judge" "$robot" "${logs[@]}") || true
  local name=${faulty##*/} said=used
  if grep -q '^refused' <<<"$result"; then said=refused; fi
  if [ "$faulty" != - ]; then
    asked=$((asked + 1))
    if grep -q "^$name,left out" <<<"$result"; then said="left out"; found=$((found + 1)); fi
    if [ "$said" = refused ]; then refused=$((refused + 1)); fi
  fi
  local wrong
  wrong=$(grep ',left out' <<<"$result" | grep -cv "^$name," || true)
  wronged=$((wronged + wrong))
  printf '%-28s %-9s healthy left out: %s\n' "${name/-/none}" "$said" "$wrong"
}

for robot in bench rrpr industrial; do
  logs=sample_logs/$robot
  mapfile -t healthy < <(ls "$logs"/healthy_*)
  one "$logs/robot.toml" - "${healthy[@]}"
  for faulty in "$logs"/*.csv "$logs"/*.flog; do
    case $faulty in *healthy* | *labels* | *'*'*) continue ;; esac
    one "$logs/robot.toml" "$faulty" "${healthy[@]:0:2}"
  done
done

# files CELL USE: the logs of that cell and use
files() { awk -F, -v cell="$1" -v use="$2" -v data="$data" 'NR > 1 && $5 == cell && $6 == use {print data "/" $1}' "$data/labels.csv"; }
faulty() { awk -F, -v cell="$1" -v data="$data" 'NR > 1 && $5 == cell && $6 == "test" && $2 != "none" {print data "/" $1}' "$data/labels.csv"; }
if [ -d "$data" ]; then
  while read -r cell l1 every; do
    printf 'axes = "RRP"\n\n[known]\nl1 = %s\n\n[log]\ntorque = "commanded"\n' "$l1" >"$out/$cell.toml"
    mapfile -t healthy < <(files "$cell" learn)
    one "$out/$cell.toml" - "${healthy[@]}"
    for log in $(faulty "$cell" | awk -v every="$every" 'NR % every == 1'); do one "$out/$cell.toml" "$log" "${healthy[@]:0:5}"; done
  done <<'CELLS'
A 0.35 6
B 0.25 3
C 1.0 3
CELLS
fi
echo "faulty logs left out: $found of $asked; refused: $refused; healthy logs left out: $wronged"
