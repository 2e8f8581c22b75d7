#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# other_debian.sh [--suite NAME] [--mirror ADDRESS] [--folder FOLDER] [CTEST ARGUMENT...]: the unit tests on another version
# of Debian than this machine's, with its compiler and its libraries. As root on a Debian machine:
#   1. installs debootstrap, and by it the version NAME (trixie: Debian 13, g++ 14, OpenCV 4.10) into FOLDER/root, with what
#      the tests need;
#   2. builds the unit tests in there (in /build) and runs them. This checkout and ../shared are there as /src and /shared,
#      read-only and only as long as the script runs.
# Needs 3 GB in FOLDER (build/NAME) and a network for 1, which later runs skip. ADDRESS is where apt gets Debian's packages
# unless told. Exit status: that of CTest.
#   bash tests/other_debian.sh -R RigidMotion
set -euo pipefail
project=$(realpath -- "$(dirname "${BASH_SOURCE[0]}")/..")
suite=trixie mirror='' folder=''
while [[ ${1:-} == --suite || ${1:-} == --mirror || ${1:-} == --folder ]]; do
  [[ -n ${2:-} ]] || { echo "$1 needs a value" >&2; exit 2; }
  case $1 in
    --suite) suite=$2 ;;
    --mirror) mirror=$2 ;;
    --folder) folder=$2 ;;
  esac
  shift 2
done
[[ $(id -u) == 0 ]] || { echo 'other_debian.sh must be root: it calls chroot' >&2; exit 2; }
folder=${folder:-$project/build/$suite}
mkdir -p "$folder/root"
folder=$(realpath "$folder")  # the caller's
root=$folder/root
cd "$project"
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
started=$SECONDS
took() { echo "tests/other_debian.sh $suite: $1 after $((SECONDS - started)) s"; }

# inside COMMAND...: in the other Debian. What is mounted for it is seen by nobody else and ends with it.
inside() {
  mkdir -p "$root/src" "$root/shared"
  ROOT=$root unshare --mount bash -euc '
    mount -t proc proc "$ROOT/proc"
    mount --rbind /dev "$ROOT/dev"
    mount --bind -o ro . "$ROOT/src"
    [[ ! -d ../shared ]] || mount --bind -o ro ../shared "$ROOT/shared"
    exec chroot "$ROOT" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      DEBIAN_FRONTEND=noninteractive CCACHE_DEPEND=1 nice -n 10 "$@"' bash "$@" < /dev/null
}

if [[ ! -e $root/complete ]]; then
  bash tests/install_packages.sh debootstrap < /dev/null
  mirror=${mirror:-$(bash tests/debian_mirror.sh)}
  rm -rf "$root"
  debootstrap --variant=minbase "$suite" "$root" "$mirror" > "$folder/debootstrap.log" ||
    { tail -n 5 "$folder/debootstrap.log" >&2; exit 1; }
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  inside apt-get update -qq
  inside apt-get install -y -qq --no-install-recommends g++ cmake ninja-build ccache libopencv-dev libeigen3-dev \
    libyaml-cpp-dev libgtest-dev nlohmann-json3-dev libcli11-dev python3-onnx > "$folder/apt.log" 2>&1 ||
    { tail -n 5 "$folder/apt.log" >&2; exit 1; }
  touch "$root/complete"
  took "$root made"
fi

inside bash -c 'g++ --version | head -n 1; dpkg-query -W libopencv-dev libeigen3-dev libyaml-cpp-dev libgtest-dev'
inside cmake -S /src -B /build -G Ninja -DCMAKE_BUILD_TYPE=Release -DSTILLPOINT_BUILD_EXAMPLES=OFF \
  -DSTILLPOINT_BUILD_BENCHMARKS=OFF -DSTILLPOINT_BUILD_DOCS=OFF -DSTILLPOINT_SHARED_DIR=/shared
inside cmake --build /build --target stillpoint_unit_tests -j"$jobs"
took built
status=0
inside ctest --test-dir /build -L unit --output-on-failure --no-tests=error -j"$jobs" "$@" || status=$?
took 'tests ended'
exit "$status"
