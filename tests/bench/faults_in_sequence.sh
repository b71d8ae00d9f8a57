#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A grave fault after another fault, one that comes twice, two at once: simulated at 500 Hz, diagnosed with a model
# of three healthy logs. Takes two minutes on two cores.
# Usage: bash tests/bench/faults_in_sequence.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export FAULTLINE=${FAULTLINE:-build/release/faultline} FAULTLINE_OUT=${FAULTLINE_OUT:-out}
if [ ! -x "$FAULTLINE" ]; then
  echo "faults_in_sequence: there is no $FAULTLINE; build it, or name it in FAULTLINE" >&2
  exit 2
fi
exec python3 tests/bench/faults_in_sequence.py "$@"
