#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Processor time, on one thread, of reading binary logs of ten columns beside peers, in turn on the same data: native
# beside the sum of a numpy memmap, HDF5 beside h5py, MCAP (not compressed) beside a copy of its bytes. Medians and
# ratios. Needs python3-numpy and python3-h5py. Usage: [BUILD=build/release] bash tests/bench/speed/formats_speed.sh [ROWS [ROUNDS]]
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build="${BUILD:-$here/../../../build/release}"
rows="${1:-2000000}" rounds="${2:-5}"
cmake --build "$build" --target faultline_formats_speed > /dev/null
ours="$build/tests/faultline_formats_speed"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
"$ours" write "$work" "$rows"

median() { sort -n "$1" | awk '{value[NR] = $1} END {print value[int((NR + 1) / 2)]}'; }
for ((round = 0; round < rounds; ++round)); do
  for format in flog h5 mcap; do "$ours" read "$work/log.$format" >> "$work/ours.$format"; done
  /usr/bin/python3 "$here/formats_speed.py" memmap "$work/raw" 10 >> "$work/peer.flog"
  /usr/bin/python3 "$here/formats_speed.py" h5py "$work/log.h5" >> "$work/peer.h5"
  "$ours" copy "$work/log.mcap" >> "$work/peer.mcap"
done
echo "| format | peer | file, MB | ours, s | peer, s | peer / ours | GB/s | million rows/s |"
echo "|---|---|---|---|---|---|---|---|"
for line in "flog sum of a numpy memmap" "h5 h5py" "mcap memcpy"; do
  format="${line%% *}" peer="${line#* }"
  size=$(stat -c %s "$work/log.$format")
  awk -v f="$format" -v p="$peer" -v a="$(median "$work/ours.$format")" -v b="$(median "$work/peer.$format")" -v s="$size" \
    -v r="$rows" 'BEGIN {printf "| %s | %s | %.0f | %.3f | %.3f | %.2f | %.2f | %.1f |\n", f, p, s / 1e6, a, b, b / a, s / a / 1e9, r / a / 1e6}'
done
