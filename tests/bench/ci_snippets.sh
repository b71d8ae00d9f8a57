#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs every command of apps/ci/golden.github.yml and apps/ci/golden.gitlab.yml as their servers would: in an empty
# folder with a golden folder in it, from installing packages and building faultline to the check. Needs root on
# Debian 12, and takes as long as a build.
# Usage: bash tests/bench/ci_snippets.sh [github] [gitlab]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source_folder=$PWD
out=out/ci-snippets
[ $# -gt 0 ] || set -- github gitlab

# The commands alone: lines below "run: |", items of before_script and script.
commands_of() {
  awk -v kind="$2" '
    { match($0, /^ */); indent = RLENGTH }
    kind == "github" && on && indent > start { print substr($0, start + 3); next }
    kind == "gitlab" && on && $1 == "-" { sub(/^ *- /, ""); print; next }
    { on = 0 }
    $1 == "run:" || $1 == "script:" || $1 == "before_script:" { on = 1; start = indent }
  ' "$1"
}

for server in "$@"; do
  rm -rf "$out/$server" && mkdir -p "$out/$server"
  cp -r sample_logs/golden "$out/$server/golden"
  commands_of "apps/ci/golden.$server.yml" "$server" >"$out/$server/commands"
  echo "ci_snippets: $server, $(wc -l <"$out/$server/commands") commands"
  (cd "$out/$server" && FAULTLINE_GIT="file://$source_folder" bash -e commands >log 2>&1) || {
    tail -20 "$out/$server/log" >&2
    exit 1
  }
  grep "as expected" "$out/$server/log"
  grep -c "<testcase" "$out/$server/golden.xml"
done
