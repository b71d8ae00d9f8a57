#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Processor time, on one thread, of reading a log of ten columns as CSV: faultline, R's data.table (fread) and
# pandas (its C engine) in turn on the same file; medians and their ratios. The peers are r-cran-data.table and
# python3-pandas. Usage: [BUILD=build/release] bash tests/bench/speed/csv_speed.sh [ROWS [ROUNDS]]
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build="${BUILD:-$here/../../../build/release}"
rows="${1:-2000000}" rounds="${2:-5}"
cmake --build "$build" --target faultline_csv_speed > /dev/null
ours="$build/tests/faultline_csv_speed"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# Median of the first numbers of the lines of a file.
median() { sort -n "$1" | awk '{value[NR] = $1} END {print value[int((NR + 1) / 2)]}'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN {printf "%.2f", a / b}'; }

echo "| numbers | file, MB | faultline, s | with SHA-256, s | fread, s | pandas, s | fread / faultline | pandas / faultline | million rows/s | memory, MB |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for numbers in shortest fixed; do
  log="$work/$numbers.csv"
  "$ours" write "$log" "$rows" "$numbers"
  rm -f "$work"/times.*
  for ((round = 0; round < rounds; ++round)); do
    "$ours" read "$log" table >> "$work/times.ours"
    "$ours" read "$log" hashed >> "$work/times.hashed"
    Rscript "$here/csv_speed.R" "$log" >> "$work/times.fread"
    /usr/bin/python3 "$here/csv_speed.py" "$log" >> "$work/times.pandas"
  done
  took="$(median "$work/times.ours")" fread="$(median "$work/times.fread")" pandas="$(median "$work/times.pandas")"
  echo "| $numbers | $(($(stat -c %s "$log") / 1000000)) | $took | $(median "$work/times.hashed") | $fread | $pandas |" \
    "$(ratio "$fread" "$took") | $(ratio "$pandas" "$took") | $(ratio "$rows" "${took}e6") |" \
    "$(awk '{if ($4 > most) most = $4} END {print most}' "$work/times.ours") |"
  rm "$log"
done
