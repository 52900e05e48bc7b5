#!/usr/bin/env bash
# What tests/run finds later (MPI, GoogleTest) leaves the objects of the program as they are, so that nothing of it
# is compiled twice: the compiler's command lines with and without are the same, but for the one file that calls MPI.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

command_lines() { # command_lines NAME [cmake argument]...: of all objects of the program, in one build folder
  local build=$folder/build
  cmake -G Ninja -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "${@:2}" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
  ninja -C "$build" -t commands cosys-sim | grep -F ' -c ' | sed "s|$build|BUILD|g" | grep -v 'cosys_sim_process_group' |
    sort >"$folder/$1.txt"
}

command_lines alone -DCOSYS_TESTS=OFF -DCOSYS_MPI=OFF
command_lines with_all -DCOSYS_TESTS=ON -DCOSYS_MPI=ON
[[ $(wc -l <"$folder/alone.txt") -gt 40 ]] || { echo 'hardly any object of the program is compiled'; exit 1; }
diff "$folder/alone.txt" "$folder/with_all.txt" >"$folder/diff" || {
  echo "$(grep -c '^>' "$folder/diff") objects of the program would be compiled again:"
  cut -c 1-300 "$folder/diff"
  exit 1
}
