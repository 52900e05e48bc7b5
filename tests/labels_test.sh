#!/usr/bin/env bash
# Each name to which tests/CMakeLists.txt gives a label is still that of a suite, in some build.
# usage: labels_test.sh FOLDER_OF_TESTS PARTS_WITH_THREADS [LABEL "A|B"]...; the label long: begun first
set -euo pipefail
cases=$(grep -rhoE '^TEST(_[FP])?\([A-Za-z0-9]+, *[A-Za-z0-9]+' --include='*_test.cpp' "$1" |
  sed -E 's/^[^(]*\(([A-Za-z0-9]+), */\1./')
lost=0

tell() { echo "$*"; lost=1; }

IFS='|' read -ra parts <<<"$2"
for part in "${parts[@]}"; do
  [[ $cases == *"$part"* ]] || tell "threads: $part is in no name of a case any more"
done

for ((i = 3; i < $#; i += 2)); do
  label=${!i} next=$((i + 1))
  case=
  [[ $label != gate && $label != weekly ]] || case=Measured # these are of measurements alone
  IFS='|' read -ra suites <<<"${!next}"
  for suite in "${suites[@]}"; do
    [[ $'\n'$cases == *$'\n'"$suite.$case"* ]] || tell "$label: $suite is no suite any more, or has no such case"
  done
done
exit "$lost"
