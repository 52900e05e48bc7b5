#!/usr/bin/env bash
# The report of a scenario's result, looked at in headless Chromium by a script of this folder.
# Usage: look_at_report.sh SCRIPT.py PROGRAM SCENARIO SCREENSHOT.png [OPTION of run]...; exits 77 (skipped) where there
# is no browser.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
script=$1 program=$2 scenario=$3 screenshot=$4
# shellcheck source=tests/browser/need_browser.sh
source "$here/need_browser.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" run "$scenario" -q "${@:5}" -o "$folder/result.h5" >"$folder/table"
"$program" report "$folder/result.h5" -o "$folder/report.html" >/dev/null
mkdir -p "$(dirname "$screenshot")"
/usr/bin/python3 -B "$here/$script" "$folder/report.html" "$screenshot"
