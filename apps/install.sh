#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the Debian 12 packages that faultline needs and that are missing. Asks nothing; works as root or
# with sudo; does nothing, quickly and without root, when all are there.
# Usage: bash apps/install.sh [--tests|--checks|--release]     --tests: what only the tests need, too; --checks: the
# same and the second compiler, clang-tidy and the fuzzer of the CI; --release: what only apps/packaging/release.sh
# needs
set -euo pipefail

case ${1:-} in
  "" | --tests | --checks | --release) ;;
  *)
    echo "install: $1 is unknown; usage: bash apps/install.sh [--tests|--checks|--release]" >&2
    exit 2
    ;;
esac

packages=(
  # to build
  g++ cmake ninja-build ccache pkg-config
  # the program
  libeigen3-dev libceres-dev libsuitesparse-dev libcli11-dev libfmt-dev nlohmann-json3-dev libtomlplusplus-dev
  libtinyxml2-dev libfast-float-dev libsqlite3-dev libssl-dev libxxhash-dev libjs-dygraphs libcpp-httplib-dev
  zlib1g-dev libzstd-dev liblz4-dev libbz2-dev libhdf5-dev
  # to configure the tests
  libgtest-dev
)
test_packages=(
  # HTML reports are looked at in a browser
  chromium fonts-dejavu-core
  # what is written is held against docs/schemas, and the documentation is built as a site
  python3-jsonschema mkdocs
  # the frames of the Python module, the networks that it exports and the pictures of its example
  python3-numpy python3-pandas python3-onnx python3-matplotlib
  # the notebook is run: 48 packages, 11 MB to load and 47 MB installed on a bare root
  python3-nbclient python3-ipykernel
  # CI checks the format of the sources
  clang-format
)
check_packages=(
  # the second compiler with its fuzzer, and the linter
  clang clang-tidy
)
release_packages=(
  # Debian packages, that of the Python module and its wheel
  dpkg-dev file git pybind11-dev python3-dev
)
case ${1:-} in --tests | --checks) packages+=("${test_packages[@]}" "${release_packages[@]}") ;; esac
[ "${1:-}" = --checks ] && packages+=("${check_packages[@]}")
[ "${1:-}" = --release ] && packages+=("${release_packages[@]}")

if ! command -v apt-get >/dev/null; then
  echo "install: this is not Debian; install the packages of this list by other means: ${packages[*]}" >&2
  exit 0
fi

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install: these packages are missing: ${missing[*]}" >&2
    echo "install: run this as root, or install sudo, or ask an administrator to run" >&2
    echo "install:   apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "install: ${missing[*]}" >&2
quiet_apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >&2; }
quiet_apt update
quiet_apt install --no-install-recommends "${missing[@]}"
