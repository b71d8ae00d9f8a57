#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh Debian 12 to fault reports: installs what is missing, builds Release, learns a model from the
# healthy logs of one sample robot and diagnoses its bad runs.
# Usage: bash apps/quickstart.sh [ROBOT]     ROBOT is a folder of sample_logs/, bench by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

robot=${1:-bench}
samples=sample_logs/$robot
out=out/quickstart/$robot
faultline=build/release/faultline

if [ ! -f "$samples/robot.toml" ]; then
  echo "quickstart: there is no $samples/robot.toml; choose one of: $(cd sample_logs && echo */)" >&2
  exit 2
fi

bash apps/install.sh
[ -f build/release/build.ninja ] || cmake --preset release >&2
cmake --build --preset release --parallel "$(nproc)" --target faultline >&2

shopt -s nullglob
healthy=() bad=()
for log in "$samples"/*.csv "$samples"/*.flog; do
  case ${log##*/} in
    labels.csv) ;;
    healthy*) healthy+=("$log") ;;
    *) bad+=("$log") ;;
  esac
done

rm -rf "$out" && mkdir -p "$out"
echo "Learning a model of $robot from ${#healthy[@]} healthy logs." >&2
"$faultline" learn "${healthy[@]}" --robot "$samples/robot.toml" -o "$out/model.json"

# The timeline alone; the report that it heads is in NAME.txt.
timeline() { awk '/^(Fault 1|Residuals)/ {exit} /^(No|[0-9]+) fault/ {on = 1} on' "$1"; }

found=0
for log in "${bad[@]}"; do
  name=${log##*/}
  name=${name%.*}
  printf '\n%s\n' "$log"
  status=0
  "$faultline" diagnose "$log" --model "$out/model.json" --json "$out/$name.json" --csv "$out/$name.csv" \
    --html "$out/$name.html" >"$out/$name.txt" || status=$?
  [ "$status" -le 1 ] || exit "$status"
  timeline "$out/$name.txt"
  found=$((found + status))
done

printf 'Faults were found in %d of %d bad runs. In %s:\n' "$found" "${#bad[@]}" "$out"
printf '  NAME.html, .txt, .json, .csv      the report of each run: plots, evidence, similar cases, what to check next\n'
printf '  model.json, model.json.cases.db   what was learned\n'
