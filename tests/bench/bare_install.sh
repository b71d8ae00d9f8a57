#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How long a bare Debian 12 takes to its first diagnosis, from the package or from source; and whether the package
# leaves nothing behind. Needs root and debootstrap; MIRROR names another mirror of Debian.
# Usage: bash tests/bench/bare_install.sh deb FOLDER-OF-RELEASE.SH   or   bash tests/bench/bare_install.sh source
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
way=${1:?deb FOLDER or source}
[ "$way" = source ] || packages=$(realpath "${2:?the folder with the packages}")

work=$(mktemp -d)
root=$work/bare
leave() { umount "$root/proc" 2>/dev/null || true; rm -rf "$work"; }
trap leave EXIT
mirror=${MIRROR:-http://deb.debian.org/debian}
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log" 2>&1
echo "deb $mirror bookworm main" >"$root/etc/apt/sources.list"
for settings in $(grep -ls '^Acquire' /etc/apt/apt.conf.d/*); do cp "$settings" "$root/etc/apt/apt.conf.d/"; done  # proxies
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
mount -t proc proc "$root/proc"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C bash -c "$1"; }
inside 'apt-get -qq update'
files() { (cd "$root" && find etc usr opt srv var -type f | grep -vE '^var/(cache|log|lib/(apt|dpkg))/|ld.so.cache' | sort); }

begin=$(date +%s.%N)
passed() { printf '%-44s %6.1f s\n' "$1" "$(echo "$(date +%s.%N) - $begin" | bc)"; }
if [ "$way" = source ]; then
  git clone -q . "$root/root/faultline"
  inside 'cd /root/faultline && bash apps/quickstart.sh' >"$work/log" 2>&1 || { tail -20 "$work/log"; exit 1; }
  passed 'source: quickstart.sh to its last report'
  tail -3 "$work/log"
  exit 0
fi
cp "$packages"/faultline_*.deb "$root/root/"
files >"$work/before"
inside 'DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends /root/faultline_*.deb' >"$work/log" 2>&1 ||
  { tail -20 "$work/log"; exit 1; }
passed 'deb: installed'
inside 'cp -r /usr/share/faultline/sample_logs/bench /root/bench && cd /root/bench &&
  faultline learn healthy_*.csv --robot robot.toml -o model.json >/dev/null 2>&1 &&
  { faultline diagnose torque_loss_1.csv --model model.json --html bad.html >bad.txt || [ $? -eq 1 ]; } && head -1 bad.txt'
passed 'deb: a model learned and a log diagnosed'
inside 'DEBIAN_FRONTEND=noninteractive apt-get -qq purge -y --autoremove faultline' >"$work/log" 2>&1
files >"$work/after"
diff "$work/before" "$work/after" >"$work/left" && echo 'deb: purged; nothing left' || { echo 'deb: left or lost:'; cat "$work/left"; }
