#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A batch of 100 000 short logs in four parts, their merge, and the same batch again: time and memory of each. The
# logs are 100 different runs of 4 s, each under many names. The parts take some 20 minutes on two cores and are
# kept, so that a second call measures the merge alone. Targets: merge in 60 s and 500 MB.
# Usage: bash tests/bench/batch_scale.sh [LOGS]     100000 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
logs=${1:-100000} parts=4
faultline=${FAULTLINE:-build/release/faultline}
out=${FAULTLINE_OUT:-out}/batch-scale
bench=sample_logs/bench
mkdir -p "$out"
[ -f "$out/bench.model" ] ||
  "$faultline" learn "$bench"/healthy_*.csv --robot "$bench/robot.toml" -o "$out/bench.model" >/dev/null

if [ ! -f "$out/different/labels.csv" ]; then
  sed '/^\[\[run\]\]/,$d' "$bench/spec.toml" >"$out/spec.toml"
  for i in $(seq -w 0 99); do
    printf '[[run]]\nname = "run_%s"\nduration_s = 4.0\n' "$i"
    [ $((10#$i % 10)) -ne 4 ] || echo 'fault = {kind = "locked", joint = 1, onset_s = 2.0}'
  done >>"$out/spec.toml"
  "$faultline" simulate "$out/spec.toml" -o "$out/different" >/dev/null
fi
if [ ! -d "$out/runs-$logs" ]; then
  /usr/bin/python3 - "$out" "$logs" <<'P'
import os, shutil, sys
out, logs = sys.argv[1], int(sys.argv[2])
for i in range(logs):
    folder = f"{out}/runs-{logs}/robot_{i % 20:02}/day_{i // 1000:03}"
    os.makedirs(folder, exist_ok=True)
    shutil.copyfile(f"{out}/different/run_{i % 100:02}.csv", f"{folder}/run_{i:06}.csv")
P
fi

# Runs a command; prints its wall seconds and its largest resident memory in MB.
measure() {
  /usr/bin/python3 - "$@" <<'P'
import resource, subprocess, sys, time
start = time.monotonic()
status = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
if status not in (0, 1):
    sys.exit(f"{sys.argv[1]} ended with status {status}")
print(f"{time.monotonic() - start:.1f} s, {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1000:.0f} MB")
P
}

folders=()
for k in $(seq "$parts"); do
  folder=$out/part-$logs-$k
  folders+=("$folder")
  [ -f "$folder/.batch/finished.json" ] || printf 'part %s: %s\n' "$k" \
    "$(measure "$faultline" batch "$out/runs-$logs" --model "$out/bench.model" -o "$folder" --shard "$k/$parts")"
done
rm -rf "$out/all"
printf 'merge of %s logs: %s\n' "$logs" "$(measure "$faultline" batch merge "${folders[@]}" -o "$out/all")"
for run in "the first run into the merged folder" "the same again"; do
  printf '%s: %s\n' "$run" "$(measure "$faultline" batch "$out/runs-$logs" --model "$out/bench.model" -o "$out/all")"
done
ls -l "$out/all"/index.* | awk '{printf "%s: %.1f MB\n", $NF, $5 / 1e6}'
