#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes an archive of a built program that runs on any x86-64 Linux: the program with all libraries that it needs, the C
# library and its loader among them, their licences, and an SPDX list of what is inside.
# Usage: bash apps/packaging/portable.sh PROGRAM VERSION ARCHIVE.tar.xz     LIBRARIES=folders to search first
# The same program and packages give the same bytes; SOURCE_DATE_EPOCH is the time of the files.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
program=$(realpath "$1") version=$2 archive=$(realpath -m "$3")
name=$(basename "$archive" .tar.xz)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root=$work/$name
mkdir -p "$root/lib" "$root/licenses"
epoch=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}

strip -o "$root/lib/faultline" "$program"
# Name and file of each library, then the loader, which stands alone on its line.
LD_LIBRARY_PATH=${LIBRARIES:-} ldd "$program" | awk '$2 == "=>" && $3 ~ /^\// {print $1, $3} $1 ~ /^\// {print "loader", $1}' |
  sort >"$work/libraries"
while read -r library file; do
  [ "$library" = loader ] && library=$(basename "$file")
  cp -L "$file" "$root/lib/$library"
done <"$work/libraries"

package_of() {
  local file
  for file in "$1" "/usr$1" "$(realpath "$1")" "$(realpath "$1" | sed 's|^/usr/lib|/lib|')"; do
    dpkg -S "$file" 2>/dev/null | grep -v '^diversion' | cut -d: -f1 | head -1 | grep . && return
  done
  echo "portable: $1 belongs to no package" >&2
  return 1
}
while read -r _ file; do package_of "$file"; done <"$work/libraries" | sort -u >"$work/packages"
while read -r package; do
  cp -L "/usr/share/doc/$package/copyright" "$root/licenses/$package"
done <"$work/packages"
cp LICENSE "$root/licenses/faultline"
cp -r sample_logs/bench "$root/sample_logs"

cat >"$root/faultline" <<'END'
#!/bin/sh
# Starts faultline with the libraries of this folder.
here=$(dirname "$(readlink -f "$0")")
FAULTLINE_PROGRAM=$here/faultline
export FAULTLINE_PROGRAM
exec "$here/lib/ld-linux-x86-64.so.2" --library-path "$here/lib" "$here/lib/faultline" "$@"
END
chmod 755 "$root/faultline" "$root/lib/ld-linux-x86-64.so.2"

cat >"$root/README" <<END
faultline $version for any x86-64 Linux. Nothing is installed; remove the folder to remove it. A first diagnosis:

    ./faultline learn sample_logs/healthy_*.csv --robot sample_logs/robot.toml -o bench.model
    ./faultline diagnose sample_logs/torque_loss_1.csv --model bench.model --html bad.html

./faultline serve FOLDER shows a folder of models as web pages; ./faultline --help names the other commands.
sbom.spdx lists the libraries in lib, with their versions; licenses has the licence of each.
END

{
  cat <<END
SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: $name
DocumentNamespace: https://spdx.org/spdxdocs/$name-$(sha256sum "$root/lib/faultline" | cut -c1-32)
Creator: Organization: the faultline authors
Created: $(date -u -d "@$epoch" +%Y-%m-%dT%H:%M:%SZ)
Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-faultline

PackageName: faultline
SPDXID: SPDXRef-faultline
PackageVersion: $version
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: false
PackageChecksum: SHA256: $(sha256sum "$root/lib/faultline" | cut -d' ' -f1)
PackageLicenseConcluded: MIT
PackageLicenseDeclared: MIT
PackageCopyrightText: the faultline authors
END
  while read -r package; do
    id=SPDXRef-$(echo "$package" | tr -c 'A-Za-z0-9.\n' '-')
    cat <<END

PackageName: $package
SPDXID: $id
PackageVersion: $(dpkg-query -W -f '${Version}' "$package:amd64" 2>/dev/null || dpkg-query -W -f '${Version}' "$package")
PackageSupplier: Organization: Debian
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: false
PackageLicenseConcluded: NOASSERTION
PackageLicenseDeclared: NOASSERTION
PackageCopyrightText: NOASSERTION
PackageComment: the licence is in licenses/$package
Relationship: SPDXRef-faultline DYNAMIC_LINK $id
END
  done <"$work/packages"
} >"$root/sbom.spdx"

mkdir -p "$(dirname "$archive")"
tar -C "$work" --sort=name --mtime="@$epoch" --owner=0 --group=0 --numeric-owner --mode='u+rwX,go+rX,go-w' -cf - "$name" |
  xz -6 -T1 >"$archive"
