#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A batch of 1000 logs of 20 s at 1 kHz: time with one and with two threads (interleaved, medians), memory at 100 and
# at 1000 logs, and the time of a pandas + scikit-learn script (batch_peer.py) on some of them.
# The 1000 are 100 different runs, each under ten names.
# Usage: bash tests/bench/batch.sh [LOGS] [ROUNDS]     1000 and 3 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
logs=${1:-1000} rounds=${2:-3}
faultline=build/release/faultline
out=out/batch-bench
robot=sample_logs/industrial
[ -x "$faultline" ] || cmake --build --preset release --target faultline >/dev/null
mkdir -p "$out"
[ -f "$out/model.json" ] ||
  "$faultline" learn "$robot"/healthy_*.flog --robot "$robot/robot.toml" -o "$out/model.json" >/dev/null

if [ ! -f "$out/different/labels.csv" ]; then
  sed -e '/^\[\[run\]\]/,$d' -e 's/^format.*/format = "csv"/' "$robot/spec.toml" >"$out/spec.toml"
  faults=('friction_increase", joint = 2, size = 2.5' 'locked", joint = 1' 'free_swinging", joint = 2' \
    'payload_change", size = 1.5' 'torque_loss", joint = 1, size = 0.6')
  for i in $(seq -w 0 99); do
    printf '[[run]]\nname = "run_%s"\nduration_s = 20\n' "$i"
    [ $((10#$i % 5)) -ne 4 ] || printf 'fault = {kind = "%s, onset_s = 12.0}\n' "${faults[$((10#$i / 5 % 5))]}"
  done >>"$out/spec.toml"
  "$faultline" simulate "$out/spec.toml" -o "$out/different" >/dev/null
fi
rm -rf "$out/runs"
for i in $(seq 0 $((logs - 1))); do
  folder=$out/runs/robot_$((i % 4))/day_$(printf %03d $((i / 20)))
  mkdir -p "$folder"
  ln "$out/different/run_$(printf %02d $((i % 100))).csv" "$folder/run_$(printf %04d "$i").csv"
done

# Runs a command; prints wall seconds, processor seconds and the largest resident memory in MB.
measure() {
  /usr/bin/python3 - "$@" <<'P'
import resource, subprocess, sys, time
start = time.monotonic()
status = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode
wall = time.monotonic() - start
used = resource.getrusage(resource.RUSAGE_CHILDREN)
if status not in (0, 1):
    sys.exit(f"{sys.argv[1]} ended with status {status}")
print(f"{wall:.2f} {used.ru_utime + used.ru_stime:.2f} {used.ru_maxrss / 1000:.0f}")
P
}

batch() { # THREADS FOLDER...
  local threads=$1
  shift
  rm -rf "$out/result"
  measure "$faultline" batch "$@" --model "$out/model.json" -o "$out/result" --threads "$threads"
}

# Processor seconds of faultline for so many logs, against the peer's a log.
compare() {
  local peer
  peer=$("$python" tests/bench/batch_peer.py "$out/different" 20 "${@:4}" 2>&1 >/dev/null | grep -o '[0-9.]* s a log' | cut -d' ' -f1)
  awk -v p="$peer" -v f="$1" -v n="$2" -v what="$3" \
    'BEGIN {printf "%s, a log: peer %.3f s, faultline %.3f s of processor time, %.1f times\n", what, p, f / n, p / (f / n)}'
}

median() { sort -n | awk '{a[NR] = $1} END {print a[int((NR + 1) / 2)]}'; }

printf '%-22s %9s %9s %9s\n' "" wall/s cpu/s RSS/MB
: >"$out/1.txt" && : >"$out/2.txt"
for _ in $(seq "$rounds"); do
  for threads in 1 2; do
    line=$(batch "$threads" "$out/runs")
    echo "$line" >>"$out/$threads.txt"
    printf '%-22s %9s %9s %9s\n' "$logs logs, $threads thread(s)" $line
  done
done
one=$(cut -d' ' -f1 "$out/1.txt" | median) two=$(cut -d' ' -f1 "$out/2.txt" | median)
printf '%-22s %9s %9s %9s\n' "100 logs, 2 thread(s)" $(batch 2 "$out/different")
awk -v a="$one" -v b="$two" -v n="$logs" \
  'BEGIN {printf "two threads: %.2f times as fast; %.1f logs a second\n", a / b, n / b}'

python=/usr/bin/python3
if "$python" -c 'import pandas, sklearn' 2>/dev/null; then
  mine=$(cut -d' ' -f2 "$out/1.txt" | median)
  compare "$mine" "$logs" "both residuals"
  read -r _ mine _ < <(batch 1 "$out/different" --classify samples)
  compare "$mine" 100 "of samples (--classify samples)" --samples
else
  echo "no peer: apt-get install python3-pandas python3-sklearn"
fi
