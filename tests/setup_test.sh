#!/usr/bin/env bash
# A build folder that was configured before a tool came finds it when the packages say that it is there, and keeps
# its settings: .ci/setup.sh at a project of three lines, with a dpkg-query that is ours.
set -euo pipefail
here=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/bin" "$root/build"
export PATH=$root/bin:$PATH
touch "$root/build/npm.log" # uPlot was asked for
echo 'test cosys-tool what this is about' >"$root/packages.txt"
# shellcheck disable=SC2016 # CMake's
echo '{"version": 6, "configurePresets": [{"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release"}]}' \
  >"$root/CMakePresets.json"
cat >"$root/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(tiny NONE)
option(COSYS_TESTS "" ON)
find_program(TOOL cosys-tool)
file(APPEND ${CMAKE_SOURCE_DIR}/seen "${COSYS_TESTS} ${TOOL}$ENV{CMAKE_CXX_COMPILER_LAUNCHER}\n")
END
tell() { printf '#!/bin/sh\n%s\n' "$2" >"$root/bin/$1" && chmod +x "$root/bin/$1"; }
# shellcheck source=.ci/setup.sh
source "$here/.ci/setup.sh"
expect() { [[ $(cat "$root/seen") == "$1" ]] || { printf 'seen:\n%s\nexpected:\n%s\n' "$(cat "$root/seen")" "$1"; exit 1; }; }

tell dpkg-query 'exit 1'
configure release COSYS_TESTS:BOOL=OFF
first="OFF TOOL-NOTFOUND$(! command -v ccache >/dev/null || echo ccache)"
expect "$first"
configure release COSYS_TESTS:BOOL=OFF
expect "$first" # nothing new, so nothing was done
tell cosys-tool 'exit 0'
tell ccache 'exit 0' # found later it is left alone
tell dpkg-query 'echo cosys-tool 1.0 installed'
configure release
expect "$first
OFF $root/bin/cosys-tool"
configure release COSYS_TESTS:BOOL=ON
expect "$first
OFF $root/bin/cosys-tool
ON $root/bin/cosys-tool"
