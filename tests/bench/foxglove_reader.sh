#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Reads the recordings of `diagnose --mcap` and `convert` with the libraries Foxglove reads files with (its MCAP reader,
# decoders of ROS 2 messages and schemas), every checksum and message, and holds the joint states against the log.
# The libraries are not among Debian's packages: the caller names the node_modules that has them
# (npm install @mcap/core @mcap/support @foxglove/rosmsg @foxglove/rosmsg2-serialization @foxglove/schemas).
# Usage: NODE_MODULES=path/to/node_modules [FAULTLINE=build/release/faultline] bash tests/bench/foxglove_reader.sh
set -euo pipefail
if [ ! -d "${NODE_MODULES:-}/@mcap/core" ]; then
  echo "foxglove_reader: set NODE_MODULES to the folder node_modules that has @mcap/core" >&2
  exit 2
fi
NODE_MODULES=$(realpath "$NODE_MODULES")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/bench/need_program.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
model=$(echo sample_logs/golden/model-*.json) cases=$(echo sample_logs/golden/cases-*.db)
status=0
for log in sample_logs/golden/logs/*.csv sample_logs/bench/{torque_loss_1,sensor_drift_2,free_swinging_2}.csv; do
  name=$(basename "$log" .csv)
  "$FAULTLINE" diagnose "$log" --model "$model" --cases "$cases" --mcap "$work/$name.mcap" >/dev/null || [ $? -eq 1 ]
  "$FAULTLINE" convert "$log" "$work/$name.converted.mcap" >/dev/null
  for recording in "$work/$name.mcap" "$work/$name.converted.mcap"; do
    node tests/bench/foxglove_reader.cjs "$NODE_MODULES" "$recording" "$log" || status=1
  done
done
exit $status
