#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Whether the portable archive runs on bare roots of other distributions: unpacked, a model learned, a log diagnosed, the
# pages served; and how long that takes. Needs root and debootstrap; a distribution that the mirror lacks is named.
# Usage: bash tests/bench/portable.sh ARCHIVE.tar.xz     MIRROR=Debian's, UBUNTU=Ubuntu's
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
archive=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
debian=${MIRROR:-http://deb.debian.org/debian} ubuntu=${UBUNTU:-http://archive.ubuntu.com/ubuntu}

try() { # NAME SUITE MIRROR
  local root=$work/$2 script=/usr/share/debootstrap/scripts/$2
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid
  if ! debootstrap --no-check-gpg --variant=minbase --include=xz-utils "$2" "$root" "$3" "$script" >"$work/$2.log" 2>&1; then
    echo "$1: the mirror does not have it ($(tail -1 "$work/$2.log"))"
    return
  fi
  cp "$archive" "$root/root/"
  local glibc begin
  glibc=$(chroot "$root" ldd --version 2>&1 | sed -n '1s/.* //p')
  begin=$(date +%s.%N)
  chroot "$root" env -i PATH=/usr/bin:/bin HOME=/root bash -ec '
    cd /root && tar -xJf *.tar.xz && date +%s.%N >/root/unpacked && cd faultline-*/
    ./faultline learn sample_logs/healthy_*.csv --robot sample_logs/robot.toml -o bench.model >/dev/null 2>&1
    ./faultline diagnose sample_logs/torque_loss_1.csv --model bench.model --html bad.html >bad.txt || [ $? -eq 1 ]
    date +%s.%N >/root/diagnosed
    mkdir robots && mv bench.model* robots/
    ./faultline serve robots --port 0 2>serve.txt & sleep 3
    kill $!; grep -hE -m1 "^[0-9]+ fault" bad.txt; head -1 serve.txt'
  printf '%s, glibc %s: from unpacking to the first diagnosis %.1f s\n' "$1" "$glibc" \
    "$(echo "$(cat "$root/root/diagnosed") - $(cat "$root/root/unpacked")" | bc)"
  rm -rf "$root"
}
try 'Debian 11' bullseye "$debian"
try 'Debian 13' trixie "$debian"
try 'Ubuntu 22.04' jammy "$ubuntu"
try 'Ubuntu 24.04' noble "$ubuntu"
