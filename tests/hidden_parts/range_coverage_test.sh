#!/usr/bin/env bash
# How far fitted parts carry against the true ones, of a few parts each week. README.md of sim/fit has it of 96.
# Usage: range_coverage_test.sh COSYS_SIM HIDDEN_PARTS
set -euo pipefail
program=$1 hidden_parts=$2
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
parts=12 seed=33 # none that README.md tells of
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program" fit --plan --minutes 4.25 -o bench >plan.log
"$hidden_parts" bench/plan.txt "$seed" "$parts" far --first-level 60
"$hidden_parts" bench/plan.txt "$seed" "$parts" near --first-level 3786 # 36 dB more
/usr/bin/python3 -B "$here/range_coverage.py" far near --program "$program" --plan bench/plan.txt \
  --scenario "$here/../../scenarios/quickstart.toml" --least 0.8 -o ranges
