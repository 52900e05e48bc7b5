#!/usr/bin/env bash
# A skipped case is told of, with its reason, and fails where COSYS_NO_SKIPS is 1: at a case that needs sigrok-cli,
# where there is none.
# usage: skips_test.sh TEST_PROGRAM SKIP.sh
set -euo pipefail
program=$1 skip=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
case=CommandLine.SigrokReadsRawSamples
fail() { printf '%s\n' "$@"; exit 1; }

run() { # run NO_SKIPS: sets `code`; what was told is in told, what was printed in out
  code=0
  rm -f "$folder/told"
  env PATH=/nowhere COSYS_SKIPPED="$folder/told" COSYS_NO_SKIPS="$1" "$program" "--gtest_filter=$case" >"$folder/out" 2>&1 || code=$?
}
run 0
[[ $code == 0 && $(cat "$folder/told") == "$case: sigrok-cli is not installed" ]] ||
  fail "code $code" "told: $(cat "$folder/told")" "$(cat "$folder/out")"
run 1
[[ $code == 1 ]] || fail "code $code in the gate"
grep -q "FAILED.*$case.*sigrok-cli is not installed" "$folder/out" || fail "nothing says why" "$(cat "$folder/out")"

for no_skips in 0 1; do
  code=0
  COSYS_SKIPPED="$folder/told" COSYS_NO_SKIPS=$no_skips "$skip" something "needs a tool" >/dev/null || code=$?
  [[ $code == $((no_skips == 1 ? 1 : 77)) ]] || fail "skip.sh ended with $code where COSYS_NO_SKIPS is $no_skips"
done
[[ $(grep -c '^something: needs a tool$' "$folder/told") == 2 ]] || fail "skip.sh did not tell" "$(cat "$folder/told")"
