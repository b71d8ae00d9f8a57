#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A mass added to each link in turn: a SCARA at 500 Hz and a six-axis arm at 250 Hz whose masses and friction
# differ by day. A model is learned from five healthy days of each; six more and four masses on each link are
# diagnosed. SEED=2 draws other days, masses and onsets. Takes some eight minutes on two cores, most of them
# for learning the six axes.
# Usage: [SEED=N] bash tests/bench/payload_links.sh [scara|six_axes...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/payload_links.py "$@"
