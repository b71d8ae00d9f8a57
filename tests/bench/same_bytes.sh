#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The guard of refactorings: hashes of what the program makes of fixed input. Record them with the program from
# before a change, check them with the one from after it; a change of structure changes no byte.
# Usage: bash tests/bench/same_bytes.sh record FILE [PART...]     or     check FILE [PART...]
#   PART is bench, industrial, rrpr (sample robots), shared (a group of the shared logs, in $FAULTLINE_SHARED_DATA),
#   golden or paper; all by default, about 8 minutes on two cores. The program is build/release/faultline or
#   $FAULTLINE. With KEEP=DIR the outputs themselves stay in DIR, to be compared by eye.
set -euo pipefail

usage() {
  sed -n '5,8s/^# //p' "${BASH_SOURCE[0]}" >&2
  exit 2
}
[ $# -ge 2 ] || usage
action=$1 list=$(realpath -m "$2")
shift 2
case $action in record | check) ;; *) usage ;; esac

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
faultline=$(realpath "${FAULTLINE:-build/release/faultline}")
if [ ! -x "$faultline" ]; then
  echo "same_bytes: there is no $faultline; build it, or name it in FAULTLINE" >&2
  exit 2
fi
shared=$(realpath -m "${FAULTLINE_SHARED_DATA:-../shared/data}")/independent-simulation
out=${KEEP:-$(mktemp -d)}
mkdir -p "$out"
[ -n "${KEEP:-}" ] || trap 'rm -rf "$out"' EXIT
out=$(realpath "$out")

# Findings are no failure here; a crash or a refused input is.
run() {
  local status=0
  "$faultline" "$@" || status=$?
  [ "$status" -le 1 ] || { echo "same_bytes: exit status $status of faultline $*" >&2; exit 1; }
}

# learn_and_diagnose DIR ROBOT.toml HEALTHY... -- LOG...
learn_and_diagnose() {
  local dir=$1 robot=$2 healthy=() log name
  shift 2
  mkdir -p "$dir"
  while [ "$1" != -- ]; do healthy+=("$1") && shift; done
  shift
  echo "same_bytes: learning $(basename "$dir")" >&2
  run learn "${healthy[@]}" --robot "$robot" -o "$dir/model" --json "$dir/learn.json" >"$dir/learn.txt"
  sed -i "s|$dir|DIR|g" "$dir/learn.txt"
  run cases export --model "$dir/model" -o "$dir/cases.json"
  run identify "${healthy[@]}" --robot "$robot" -o "$dir/identified.toml" --json - >"$dir/identified.json"
  for log in "$@"; do
    name=$(basename "$log")
    run diagnose "$log" --model "$dir/model" --json "$dir/$name.json" --csv "$dir/$name.report.csv" \
      --html "$dir/$name.html" --md "$dir/$name.md" --junit "$dir/$name.xml" >"$dir/$name.txt"
    run diagnose "$log" --model "$dir/model" --classify samples --json "$dir/$name.samples.json" \
      --html "$dir/$name.samples.html" >"$dir/$name.samples.txt"
    run diagnose "$log" --model "$dir/model" --classify samples --criterion consecutive \
      --json "$dir/$name.consecutive.json" >/dev/null
    run inspect "$log" --json "$dir/$name.inspect.json" >"$dir/$name.inspect.txt"
    run convert "$log" "$dir/$name.converted.flog" && run convert "$log" "$dir/$name.converted.csv"
  done >/dev/null
  run batch "$@" --model "$dir/model" -o "$dir/batch" --json "$dir/batch.json" >"$dir/batch.txt" 2>/dev/null
  # What depends on folders or clocks is not compared; the case base is, as its export.
  sed -i "s|$dir|DIR|g" "$dir/batch.txt"
  rm -rf "$dir"/batch/*journal* "$dir/model.cases.db"
}

sample_robot() {
  local samples=sample_logs/$1 healthy=() all=() log
  for log in "$samples"/*.csv "$samples"/*.flog; do
    [ -f "$log" ] || continue
    case ${log##*/} in
      labels.csv) continue ;;
      healthy*) healthy+=("$log") ;;
    esac
    all+=("$log")
  done
  learn_and_diagnose "$out/$1" "$samples/robot.toml" "${healthy[@]}" -- "${all[@]}"
}

# The 73 ms group: quick, and its fault-free logs leave work for networks and cases.
shared_group() {
  if [ ! -d "$shared" ]; then
    echo "same_bytes: $shared is not there; part shared is left out" >&2
    return
  fi
  local healthy=() all=() number
  mkdir -p "$out/shared"
  printf 'axes = "RRP"\n[known]\nl1 = 1.0\n[log]\ntorque = "commanded"\ntorque_between_samples = "held"\n' \
    >"$out/shared/robot.toml"
  for number in $(seq -w 060 081); do
    [ -f "$shared/t_$number.csv" ] && all+=("$shared/t_$number.csv")
  done
  while read -r number; do healthy+=("$shared/$number"); done < <(
    awk -F, '$1 >= "t_060.csv" && $1 <= "t_070.csv" && $2 == "none" {print $1}' "$shared/labels.csv")
  learn_and_diagnose "$out/shared" "$out/shared/robot.toml" "${healthy[@]}" -- "${all[@]}"
}

golden() {
  mkdir -p "$out/golden"
  echo "same_bytes: golden" >&2
  run golden check sample_logs/golden --json "$out/golden/check.json" --junit "$out/golden/check.xml" >"$out/golden/check.txt"
  local model
  model=$(echo sample_logs/golden/model-*.json)
  run golden record sample_logs/golden/logs/* --model "$model" --cases "$(echo sample_logs/golden/cases-*.db)" \
    -o "$out/golden/recorded" >/dev/null
  rm -f "$out"/golden/recorded/*.db
}

paper() {
  mkdir -p "$out/paper"
  echo "same_bytes: paper" >&2
  run reproduce --quick -o "$out/paper" >/dev/null
}

parts=("$@")
[ ${#parts[@]} -gt 0 ] || parts=(bench industrial rrpr shared golden paper)
for part in "${parts[@]}"; do
  rm -rf "${out:?}/$part"
  case $part in
    bench | industrial | rrpr) sample_robot "$part" ;;
    shared) shared_group ;;
    golden) golden ;;
    paper) paper ;;
    *) usage ;;
  esac
done

hashes() { (cd "$out" && find . -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum); }
if [ "$action" = record ]; then
  hashes >"$list"
  echo "same_bytes: $(wc -l <"$list") files recorded in $list"
  exit 0
fi
chosen=$(IFS='|' && echo "${parts[*]}")
if diff <(grep -E "  \./($chosen)/" "$list") <(hashes) >"$out.differences"; then
  echo "same_bytes: all $(hashes | wc -l) files are the same"
else
  echo "same_bytes: these files differ (< recorded, > now):"
  cat "$out.differences"
  exit 1
fi
rm -f "$out.differences"
