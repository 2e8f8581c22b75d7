#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# fetch_onnxruntime.sh ROOT [CACHE]: ONNX Runtime for the tests, where the distribution has none: ROOT/include and
# ROOT/lib, for -DONNXRUNTIME_ROOT=ROOT. Needs npm, Linux on x86-64 and 0.3 GB; where ROOT is complete it does nothing.
# With CACHE, the package (150 MB) is kept there, and taken from there. Exit status: 2 wrong use or machine, 3 no npm,
# 4 the download failed, 5 what came is not what was expected.
set -euo pipefail

# A plugin for a game engine, of which two things are taken: the library for Linux, and the headers, which lie in another
# platform's folder but are the same for all. Nothing of the package is run.
package=com.github.asus4.onnxruntime version=0.4.9  # ONNX Runtime 1.29, MIT
sha256=e59788788818fdde1b2e522e766a21ba0f7d8391de55737abf81e32cc801785d
library=package/Plugins/Linux/x64/libonnxruntime.so
headers=package/Plugins/iOS~/onnxruntime.xcframework/ios-arm64/onnxruntime.framework/Headers
notices=(package/LICENSE package/ThirdPartyNotices.txt)

fail() {
  local status=$1
  shift
  echo "fetch_onnxruntime.sh: $*" >&2
  exit "$status"
}

[[ $# == 1 || $# == 2 ]] || fail 2 'usage: fetch_onnxruntime.sh ROOT [CACHE]'
root=$1
stamp=$root/$package-$version-$sha256
if [[ -f $stamp ]]; then
  echo "ONNX Runtime is in $root already"
  exit 0
fi
[[ $(uname -sm) == 'Linux x86_64' ]] || fail 2 "the package has a library for Linux x86_64, this is $(uname -sm)"

mkdir -p "$root"
work=$(mktemp -d "$root/fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
cache=${2:-$work}
mkdir -p "$cache"
archive=$cache/$package-$version.tgz

is_right() { [[ -f $1 ]] && sha256sum --check --status <<< "$sha256  $1"; }

if ! is_right "$archive"; then
  command -v npm > /dev/null || fail 3 'npm was not found, which downloads it (Debian: npm)'
  # npm leaves a file only when all of it has come; in a folder of its own, so that no settings of a project are read.
  (cd "$work" && npm pack "$package@$version" --ignore-scripts --loglevel=error --fetch-retries=3 > npm.log 2>&1) ||
    fail 4 "npm could not download $package@$version: is there a network? $(head -n 4 "$work/npm.log" | tr '\n' ' ')"
  [[ $cache == "$work" ]] || mv -f "$work/$package-$version.tgz" "$archive"
  is_right "$archive" || fail 5 "$package@$version has the SHA-256 $(sha256sum < "$archive" | cut -d' ' -f1), expected $sha256"
fi

tar -xzf "$archive" -C "$work" "$library" "$headers" "${notices[@]}" || fail 5 "$archive has not the expected files"
rm -rf "$root/include" "$root/lib" "$root/share"
mkdir -p "$root/lib" "$root/share"
mv "$work/$headers" "$root/include"
mv "$work/$library" "$root/lib/libonnxruntime.so.1"  # by its soname, under which programs look for it
for notice in "${notices[@]}"; do mv "$work/$notice" "$root/share/"; done
touch "$stamp"
echo "ONNX Runtime is in $root now"
