#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the image of apps/ci/Containerfile on a Debian 12 made by debootstrap (no registry of images is asked), then
# checks the golden runs in it as a CI job would. Runs in a chroot rather than a container, so that it works where none
# may be started. Needs root, debootstrap and buildah; MIRROR names another mirror.
# Usage: bash tests/bench/image.sh FOLDER-OF-RELEASE.SH
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
packages=$(realpath "${1:?the folder with the packages}")
work=$(mktemp -d)
leave() {
  buildah rm faultline-debian faultline-job >/dev/null 2>&1 || true
  buildah rmi -f faultline-bench faultline-bench-debian >/dev/null 2>&1 || true
  rm -rf "$work"
}
trap leave EXIT
debootstrap --variant=minbase bookworm "$work/root" "${MIRROR:-http://deb.debian.org/debian}" >"$work/log" 2>&1 ||
  { tail -5 "$work/log"; exit 1; }
for settings in $(grep -ls '^Acquire' /etc/apt/apt.conf.d/*); do cp "$settings" "$work/root/etc/apt/apt.conf.d/"; done  # proxies
buildah from --name faultline-debian scratch >/dev/null
buildah add -q faultline-debian "$work/root" / >/dev/null
buildah commit -q faultline-debian faultline-bench-debian >/dev/null
size() { buildah images --format '{{.Size}}' "localhost/$1"; }
begin=$(date +%s)
buildah build -q --no-cache --isolation chroot --network host --from localhost/faultline-bench-debian -t faultline-bench \
  -f apps/ci/Containerfile "$packages" >"$work/log" 2>&1 || { tail -20 "$work/log"; exit 1; }
echo "image: built in $(($(date +%s) - begin)) s, $(size faultline-bench), of which Debian $(size faultline-bench-debian)"
cp -r sample_logs "$work/mine"
buildah from --name faultline-job localhost/faultline-bench >/dev/null
entry=$(buildah inspect --type image -f '{{.OCIv1.Config.Entrypoint}}' localhost/faultline-bench | tr -d '[]')
buildah run --isolation chroot -v "$work/mine:/work" faultline-job -- $entry golden check golden --junit golden.xml | tail -3
echo "image: golden runs in golden.xml: $(grep -c '<testcase' "$work/mine/golden.xml")"
