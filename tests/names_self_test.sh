#!/usr/bin/env bash
# Proves that names_test.sh can fail: of two files made for it, each pair below is allowed or caught.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
wrong=0

expect() { # expect allowed|caught FILE TEXT FILE TEXT
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/{dsp,channel,protocol,sim/link,tests/sim}
  printf '%b' "$3" >"$tree/$2"
  printf '%b' "$5" >"$tree/$4"
  local found=allowed
  "$here/names_test.sh" "$tree" >"$tree/said" || found=caught
  [[ $found == "$1" ]] || { echo "'$3' in $2 and '$5' in $4 should be $1, are $found"; wrong=1; }
}

expect caught sim/a.hpp 'struct A {\n' sim/link/b.cpp 'class A {\n'
expect caught sim/a.hpp 'struct A : B {\n' sim/b.hpp 'enum class A { x };\n'
expect caught sim/a.cpp 'namespace {\n}  // namespace\nstruct A {\n' sim/b.hpp 'struct A {\n'
expect caught tests/sim/a.cpp 'class A : public Test {\n' tests/sim/b.cpp 'class A : public Test {\n'
expect allowed sim/a.hpp 'struct A {\n' sim/b.hpp 'struct A;\n'
expect allowed sim/a.hpp 'struct A {\n' dsp/b.hpp 'struct A {\n'
expect allowed sim/a.cpp 'namespace {\nstruct A {\n' sim/b.cpp 'namespace {\nstruct A {\n'
expect allowed sim/a.hpp 'struct A {\n' sim/a.cpp 'struct A::State {\n'
expect allowed dsp/a.hpp 'struct A {\n' dsp/b.hpp 'struct A<int> {\n'
exit "$wrong"
