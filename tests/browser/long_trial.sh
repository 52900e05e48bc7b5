#!/usr/bin/env bash
# The report of a message of ten million samples, seventeen seconds at 10 Bd, in headless Chromium (long_trial.py).
# Usage: long_trial.sh PROGRAM SCENARIO SCREENSHOT.png; exits 77 (skipped) where there is no browser.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$1 scenario=$2 screenshot=$3
# shellcheck source=tests/browser/need_browser.sh
source "$here/need_browser.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" run "$scenario" -q -n 8 -o "$folder/result.h5" --set device.baud=10 --set simulation.warmup_messages=0 \
  --set receiver.module=TSSP4056 --set receiver.range_m=2 >"$folder/table"
"$program" report "$folder/result.h5" -o "$folder/report.html" >/dev/null
mkdir -p "$(dirname "$screenshot")"
/usr/bin/python3 -B "$here/long_trial.py" "$folder/report.html" "$screenshot"
