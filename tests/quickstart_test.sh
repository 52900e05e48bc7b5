#!/usr/bin/env bash
# The quickstart as README.md shows it: its digest, and a trace of it that sigrok reads as the bytes that `encode`
# prints. That threads do not matter, sim/golden_digests_test.cpp says of all scenarios.
# usage: quickstart_test.sh PROGRAM
set -euo pipefail
program=$1
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
quickstart=$root/scenarios/quickstart.toml
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
wrong=0

digest_of() { grep -o 'digest [0-9a-f]\{32\}' "$1" || echo "no digest in $1"; }
setting() { sed -n "s/^$1 = \"\?\([^\"#]*[^\"# ]\).*/\1/p" "$quickstart"; }
expect() { [[ $2 == "$3" ]] || { printf '%s:\n%s\nexpected:\n%s\n' "$1" "$2" "$3"; wrong=1; }; }

"$program" run "$quickstart" --quiet -o run.h5 >run.txt
expect 'digest in README.md' "$(digest_of "$root/README.md")" "$(digest_of run.txt)"

"$program" trace "$quickstart" -o t.vcd
line=$("$program" encode "$(setting message)")
lines=$(for ((i = 0; i <= $(setting warmup_messages); ++i)); do echo "$line"; done)
for wire in tx rx; do
  expect "$wire as sigrok reads it" "$(sigrok-cli -i t.vcd -P "uart:rx=$wire:baudrate=600" -B uart=rx)" "$lines"
done
exit "$wrong"
