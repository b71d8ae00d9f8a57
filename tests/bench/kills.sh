#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Kills every writing command at random moments, lets it write onto full disks and past a file size limit, and
# runs it again: whether something was lost, and whether something is left behind. The full disks are small
# tmpfs mounts in a name space of their own; they are left out where there is none.
# Usage: bash tests/bench/kills.sh [KILLS] [FULL] [FAILING] [SEED]     300, 20, 20 and 1 by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
mkdir -p "$FAULTLINE_OUT/kills"
own=()
unshare -Urm true 2>/dev/null && own=(unshare -Urm)
exec "${own[@]}" "${PYTHON:-python3}" tests/bench/kills.py "$FAULTLINE" "$FAULTLINE_OUT/kills" "$@"
