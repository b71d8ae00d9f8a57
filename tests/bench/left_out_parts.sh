#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Healthy recordings of real arms, judged by models that have not seen them: each recording is cut into three parts, and
# each part is diagnosed with a model learned from the other two. No part should be in alarm. Needs numpy, and scipy for
# tx40; takes some fifteen minutes on two cores.
# Usage: bash tests/bench/left_out_parts.sh [ROBOT...]    with the data in $FAULTLINE_SHARED_DATA
#   ROBOT is ur3, ur10, tx40, doosan or doosan_current; all by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec "${PYTHON:-/usr/bin/python3}" tests/bench/left_out_parts.py "${FAULTLINE_SHARED_DATA:-../shared/data}" "$@"
