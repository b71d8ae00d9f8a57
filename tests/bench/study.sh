# SPDX-License-Identifier: MIT
# Sourced by the studies: learn a group's healthy logs alone, diagnose all its logs, keep what score.py reads.

faultline=${FAULTLINE:-build/release/faultline}
if [ ! -x "$faultline" ]; then
  echo "study: there is no $faultline; build it, or name it in FAULTLINE" >&2
  exit 2
fi

# study_group DIR LOGS: DIR holds robot.toml and labels.csv, LOGS the files that the labels name.
study_group() {
  local group=$1 logs=$2 healthy=() file start status
  while read -r file; do healthy+=("$logs/$file"); done < <(awk -F, 'NR > 1 && $2 == "none" {print $1}' "$group/labels.csv")
  mkdir -p "$group/reports"
  echo "learning ${group##*/} from ${#healthy[@]} logs" >&2
  start=$(date +%s.%N)
  "$faultline" learn "${healthy[@]}" --robot "$group/robot.toml" -o "$group/model.json" --json "$group/learn.json" \
    >"$group/learn.txt"
  awk -v from="$start" -v to="$(date +%s.%N)" 'BEGIN {print to - from}' >"$group/learn_s"
  for file in $(awk -F, 'NR > 1 {print $1}' "$group/labels.csv"); do
    status=0
    "$faultline" diagnose "$logs/$file" --model "$group/model.json" --json "$group/reports/$file.json" \
      >"$group/reports/$file.txt" || status=$?
    [ "$status" -le 1 ] || exit "$status"
  done
}
