#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# arm64.sh [--mirror ADDRESS] [--folder FOLDER] [CTEST ARGUMENT...]: the unit tests on arm64, the processors of Jetson and
# Raspberry Pi. On a Debian machine of any kind:
#   1. installs g++-aarch64-linux-gnu and qemu-user-static (as root; else says which are missing);
#   2. downloads the libraries for arm64, of this machine's version of Debian, and unpacks them into FOLDER/sysroot. Nothing of
#      them is installed or run, so that neither root nor binfmt_misc is needed;
#   3. cross-compiles the unit tests into FOLDER/build and runs them in qemu-user.
# Needs 2.5 GB in FOLDER (build/arm64) and a network for 1 and 2, which later runs skip. ADDRESS is where apt gets Debian's
# packages unless told. Exit status: that of CTest.
#   bash tests/arm64.sh -R RigidMotion
set -euo pipefail
root=$(realpath -- "$(dirname "${BASH_SOURCE[0]}")/..")
mirror='' folder=$root/build/arm64
while [[ ${1:-} == --mirror || ${1:-} == --folder ]]; do
  [[ -n ${2:-} ]] || { echo "$1 needs a value" >&2; exit 2; }
  [[ $1 == --mirror ]] && mirror=$2 || folder=$2
  shift 2
done
mkdir -p "$folder"
folder=$(realpath "$folder")  # the caller's
cd "$root"
sysroot=$folder/sysroot
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
started=$SECONDS
took() { echo "tests/arm64.sh: $1 after $((SECONDS - started)) s"; }

bash tests/install_packages.sh g++-aarch64-linux-gnu qemu-user-static cmake ninja-build dpkg-dev python3-onnx < /dev/null

if [[ ! -e $sysroot/complete ]]; then
  rm -rf "$sysroot" "$folder/apt"
  mirror=${mirror:-$(bash tests/debian_mirror.sh)}
  suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
  # An apt of its own, for which nothing is installed yet.
  mkdir -p "$folder"/apt/{etc/apt/{apt.conf,preferences}.d,var/{lib/{apt/lists,dpkg},cache/apt/archives}/partial}
  touch "$folder/apt/var/lib/dpkg/status"
  keyring=/usr/share/keyrings/debian-archive-keyring.gpg
  echo "deb [signed-by=$keyring] $mirror $suite main" > "$folder/apt/etc/apt/sources.list"
  apt=(apt-get -qq -o "Dir=$folder/apt" -o "Dir::State::status=$folder/apt/var/lib/dpkg/status" -o APT::Architecture=arm64
    -o APT::Architectures=arm64 -o APT::Sandbox::User= -o Acquire::Retries=3)
  "${apt[@]}" update
  "${apt[@]}" install --yes --download-only --no-install-recommends libc6-dev libopencv-dev libeigen3-dev libyaml-cpp-dev \
    libgtest-dev nlohmann-json3-dev libcli11-dev
  took "$(find "$folder/apt/var/cache/apt/archives" -name '*.deb' | wc -l) packages downloaded"
  mkdir -p "$sysroot/usr/"{bin,lib,sbin}
  ln -s usr/bin usr/lib usr/sbin "$sysroot"
  for package in "$folder"/apt/var/cache/apt/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink -C "$sysroot"
  done
  # The two libraries that Debian finds by links made at installation.
  for library in blas/libblas.so.3 lapack/liblapack.so.3; do
    ln -sf "$library" "$sysroot/usr/lib/aarch64-linux-gnu/${library#*/}"
  done
  rm -rf "$folder/apt"
  touch "$sysroot/complete"
  took "$sysroot made"
fi

# ThreadSanitizer needs more of a kernel than qemu-user is.
nice -n 10 cmake -S . -B "$folder/build" -G Ninja -DCMAKE_TOOLCHAIN_FILE=tests/arm64_toolchain.cmake \
  "-DSTILLPOINT_SYSROOT=$sysroot" -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_EXAMPLES=OFF -DSTILLPOINT_BUILD_BENCHMARKS=OFF \
  -DSTILLPOINT_BUILD_DOCS=OFF -DSTILLPOINT_HAS_THREAD_SANITIZER=OFF -DSTILLPOINT_TEST_TIMEOUT_S=3600
nice -n 10 cmake --build "$folder/build" --target stillpoint_unit_tests -j"$jobs"
took built
status=0
nice -n 10 ctest --test-dir "$folder/build" -L unit --output-on-failure --no-tests=error -j"$jobs" "$@" || status=$?
took "tests ended"
exit "$status"
