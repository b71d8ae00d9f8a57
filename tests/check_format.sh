#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Says which sources are not as clang-format 14 would have them. Mend: clang-format -i FILE...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v clang-format >/dev/null; then
  echo "check_format: there is no clang-format; install it (bash apps/install.sh --tests)" >&2
  exit 2
fi
git ls-files -z '*.hpp' '*.cpp' | xargs -0 clang-format --dry-run -Werror
echo "check_format: all sources are formatted"
