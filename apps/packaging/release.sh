#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes what is handed out of the last commit: the Debian packages, the Python wheel, the source archive, an archive that
# runs on any x86-64 Linux, and their checksums.
# The same commit gives the same bytes on the same Debian release.
# Usage: bash apps/packaging/release.sh [FOLDER]     FOLDER is dist by default
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=$(realpath -m "${1:-dist}")

if ! commit=$(git rev-parse --short HEAD 2>/dev/null); then
  echo "release: this is not a checkout of the repository; a release is made from a commit" >&2
  exit 2
fi
[ -z "$(git status --porcelain)" ] || echo "release: uncommitted changes are left out" >&2

bash apps/install.sh
bash apps/install.sh --release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(sed -n 's/^project(faultline VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
source_archive=faultline-$version.tar.gz
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH

git archive --format=tar --prefix="faultline-$version/" HEAD | gzip -9n >"$work/$source_archive"
tar -xzf "$work/$source_archive" -C "$work"
# A name that does not change, so that no path of this machine or run gets into the program.
(cd "$work/faultline-$version" && cmake --preset release -B "$work/build" -DFAULTLINE_TESTS=OFF \
  -DCMAKE_CXX_FLAGS="-ffile-prefix-map=$work=." >&2)
cmake --build "$work/build" --parallel "$(nproc)" --target all faultline_wheel >&2
# The reference BLAS stands for all of them, whichever this machine prefers.
blas=$(dpkg -L libblas3 liblapack3 | grep '\.so\.3$' | xargs -n1 dirname | paste -sd:)
(cd "$work/build" && LD_LIBRARY_PATH=$blas cpack -B "$work" >&2)
LIBRARIES=$blas bash apps/packaging/portable.sh "$work/build/faultline" "$version" \
  "$work/faultline-$version-linux-x86_64.tar.xz"

mkdir -p "$out"
rm -f "$out"/faultline_*.deb "$out"/libfaultline-dev_*.deb "$out"/python3-faultline_*.deb "$out"/faultline-*.tar.* "$out"/faultline-*.whl
cp "$work"/*.deb "$work"/build/dist/*.whl "$work/$source_archive" "$work"/faultline-*-linux-x86_64.tar.xz "$out"
(cd "$out" && sha256sum -- *.deb *.whl *.tar.* >SHA256SUMS)
echo "Of commit $commit, in $out:"
(cd "$out" && ls -1s --block-size=K -- *.deb *.whl *.tar.* SHA256SUMS)
