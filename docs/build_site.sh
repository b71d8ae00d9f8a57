#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the documentation as a site of plain files that load nothing from elsewhere; open OUT/index.html.
# Usage: bash docs/build_site.sh [OUT]     OUT is build/site by default; what is in it is replaced
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$(realpath -m "${1:-$here/../build/site}")

if ! command -v mkdocs >/dev/null; then
  echo "build_site: mkdocs is missing; install it with: bash apps/install.sh --tests" >&2
  exit 3
fi
if [ -e "$out" ] && [ -n "$(ls -A "$out")" ] && [ ! -e "$out/style.css" ]; then
  echo "build_site: $out is no site that was built before; give an empty or a new folder" >&2
  exit 2
fi
mkdocs build --strict --quiet -f "$here/site/mkdocs.yml" -d "$out"
# What builds the site is no part of it, and a map of the site says when it was built.
rm -rf "$out/site" "$out/build_site.sh" "$out"/pictures/*.py "$out"/sitemap.xml*
# A page opened as a file cannot fetch JSON, but it can load a script: the search index becomes one.
{ printf 'const searchIndex = '; cat "$out/search/search_index.json"; } >"$out/search_index.js"
rm -rf "$out/search"
echo "$out/index.html"
