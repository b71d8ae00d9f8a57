#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the whole reproduction of the paper and makes docs/paper.md and its pictures of it.
set -euo pipefail
cd "$(dirname "$0")/../.."

program=${FAULTLINE_PROGRAM:-build/release/faultline}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

time "$program" reproduce -o "$folder" "$@"
mkdir -p docs/paper
rm -f docs/paper/*.svg
cp "$folder"/*.svg docs/paper/
sed 's/](\([a-z0-9_.]*\.svg\))/](paper\/\1)/' "$folder/index.md" > docs/paper.md
