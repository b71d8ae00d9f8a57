#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the Python module costs: the time to import it, without and with numpy, and the processor time of a
# diagnosis of a frame of 600 000 rows against that of the program on the same log, in pairs, of which the median
# ratio is told (at most 1.1 is promised).
# Usage: bash tests/bench/python_speed.sh [PAIRS]
#   The program is $FAULTLINE (build/release/faultline), the module lies in $FAULTLINE_PYTHON (python/ beside it).
set -euo pipefail
pairs=${1:-5}
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
faultline=$(realpath "${FAULTLINE:-build/release/faultline}")
module=$(realpath "${FAULTLINE_PYTHON:-$(dirname "$faultline")/python}")
for needed in "$faultline" "$module/faultline/__init__.py"; do
  [ -e "$needed" ] || { echo "python_speed: there is no $needed; build it" >&2; exit 2; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PYTHONPATH=$module PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 tests/bench/python_speed.py "$faultline" "$pairs" "$work"
