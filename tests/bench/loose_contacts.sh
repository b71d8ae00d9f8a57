#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Faults that come and go, such as by a loose contact: three kinds at each joint of the robots of own_cells.sh, which stay,
# come twice, are gone for a while, or come four times. Takes two minutes on two cores.
# Usage: bash tests/bench/loose_contacts.sh     SEED in the environment draws other robots
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
exec python3 tests/bench/loose_contacts.py
