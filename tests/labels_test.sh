#!/usr/bin/env bash
# Each name to which tests/CMakeLists.txt gives a label is still that of a suite, which has it.
# usage: labels_test.sh FOLDER_OF_SUITES TEST_PROGRAM PARTS_WITH_THREADS [LABEL "A|B"]...; the label long: begun first
set -euo pipefail
entries=$(cat "$1"/*_suites.cmake)
cases=$("$2" --gtest_list_tests | awk '/^[^ ]/ { suite = $1; next } { print suite $1 }')
lost=0

tell() { echo "$*"; lost=1; }

IFS='|' read -ra parts <<<"$3"
for part in "${parts[@]}"; do
  grep -q "$part" <<<"$cases" || tell "threads: $part is in no name of a case any more"
done

for ((i = 4; i < $#; i += 2)); do
  label=${!i} next=$((i + 1))
  has="LABELS \[=\[([a-z;]*;)?$label\]=\]"
  [[ $label != long ]] || has='LABELS .* COST 50'
  IFS='|' read -ra suites <<<"${!next}"
  for suite in "${suites[@]}"; do
    grep -qE "\[=\[[a-z]+\.([^]]*/)?$suite(\.measured)?\]=\] PROPERTIES $has" <<<"$entries" ||
      tell "$label: $suite is no suite any more, or has no such case"
  done
done
exit "$lost"
