#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the exported networks in ONNX Runtime, of the sample model and of models with other kinds of networks, and tells
# how far its outputs are from those of faultline, on the rows of the sample logs and on rows at random. ONNX Runtime is
# not among Debian's packages: the caller names the folder of its package for Node.js.
# Usage: ONNXRUNTIME=path/to/node_modules/onnxruntime-node bash tests/bench/onnx_runtime.sh
#   The module is that of $FAULTLINE_PYTHON (build/release/python).
set -euo pipefail
if [ ! -f "${ONNXRUNTIME:-}/package.json" ]; then
  echo "onnx_runtime: set ONNXRUNTIME to the folder of onnxruntime-node, such as node_modules/onnxruntime-node" >&2
  exit 2
fi
ONNXRUNTIME=$(realpath "$ONNXRUNTIME")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/bench/need_program.sh
module=$(realpath "${FAULTLINE_PYTHON:-$(dirname "$FAULTLINE")/python}")
[ -e "$module/faultline/__init__.py" ] || { echo "onnx_runtime: there is no $module/faultline; build it" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PYTHONPATH=$module:tests/apps/python PYTHONDONTWRITEBYTECODE=1 FAULTLINE_PROGRAM=$(realpath "$FAULTLINE") \
  /usr/bin/python3 tests/bench/onnx_runtime.py "$work"
node tests/bench/onnx_runtime.cjs "$ONNXRUNTIME" "$work"
