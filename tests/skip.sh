#!/usr/bin/env bash
# Ends a test that is a script as skipped (77), or as failed where COSYS_NO_SKIPS is 1; tests/run tells of it.
# Usage: skip.sh NAME REASON; a script that calls it ends with `|| exit $?`, or is it itself.
set -euo pipefail
[[ -z ${COSYS_SKIPPED:-} ]] || printf '%s: %s\n' "$1" "$2" >>"$COSYS_SKIPPED"
echo "skipped: $2"
[[ ${COSYS_NO_SKIPS:-0} != 1 ]] || { echo "(which the gate does not take)"; exit 1; }
exit 77
