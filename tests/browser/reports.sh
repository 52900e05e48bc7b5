#!/usr/bin/env bash
# The reports of shipped scenarios, each opened and used in headless Chromium (open_report.py).
# Usage: reports.sh PROGRAM SCENARIO SCREENSHOT.png [OPTION OF run]...; exits 77 (skipped) where there is no browser.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$1 scenario=$2 screenshot=$3
# shellcheck source=tests/browser/need_browser.sh
source "$here/need_browser.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" run "$scenario" -q "${@:4}" -o "$folder/result.h5" >"$folder/table"
"$program" report "$folder/result.h5" -o "$folder/report.html" >/dev/null
mkdir -p "$(dirname "$screenshot")"
/usr/bin/python3 -B "$here/open_report.py" "$folder/report.html" "$screenshot"
