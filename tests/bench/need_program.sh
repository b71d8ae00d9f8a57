# SPDX-License-Identifier: MIT
# Sourced by the benches from the project's folder: FAULTLINE is the program to measure, the release build by default,
# FAULTLINE_OUT the folder for what they write.
export FAULTLINE=${FAULTLINE:-build/release/faultline} FAULTLINE_OUT=${FAULTLINE_OUT:-out}
if [ ! -x "$FAULTLINE" ]; then
  echo "$(basename "$0" .sh): there is no $FAULTLINE; build it, or name it in FAULTLINE" >&2
  exit 2
fi
