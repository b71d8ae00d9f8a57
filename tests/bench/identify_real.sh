#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Identification on logs of real robots that this project did not make: faultline identify and an
# inverse-dynamics least squares in numpy (identify_real.py), both judged on held-out parts of the logs.
# Usage: bash tests/bench/identify_real.sh [ROBOT...]    with the data in $FAULTLINE_SHARED_DATA
#   ROBOT is double_pendulum, acrobot, pendubot, emps or staubli_tx40; all by default. The program is
#   $FAULTLINE or build/release/faultline. Needs numpy and scipy for $PYTHON (python3 by default).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
faultline=${FAULTLINE:-build/release/faultline}
if [ ! -x "$faultline" ]; then
  echo "identify_real: there is no $faultline; build it, or name it in FAULTLINE" >&2
  exit 2
fi
exec "${PYTHON:-python3}" tests/bench/identify_real.py --faultline "$faultline" \
  --data "${FAULTLINE_SHARED_DATA:-../shared/data}" --out out/identify-real "$@"
