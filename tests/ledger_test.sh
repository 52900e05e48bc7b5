#!/usr/bin/env bash
# The ledger (channel/README.md) pins models by names of tests: each of them must be a test.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
ledger=${1:-$root/channel/README.md}

# SUITE.NAME of each test, and FOLDER.SUITE.NAME as ctest calls it.
tests=$(cd "$root/tests" && grep -rHoE 'TEST(_F|_P)?\([A-Za-z]+, *[A-Za-z0-9_]+' --include='*.cpp' . |
  sed -E 's|^\./([a-z]+)/.*\(([A-Za-z]+), *([A-Za-z0-9_]+)$|\2.\3\n\1.\2.\3|')

# Names as the ledger writes them: `suite.Name`, `Suite.Name_*`; not files.
# shellcheck disable=SC2016 # the backticks are the ledger's
names=$(grep -oE '`[A-Za-z]+(\.[A-Za-z0-9_*]+)+`' "$ledger" | tr -d '\`' | grep -vE '\.(toml|cpp|hpp|md)$' | sort -u)

missing=0 named=0
while read -r name; do
  named=$((named + 1))
  pattern="^${name//\*/[A-Za-z0-9_]*}"
  if ! grep -qE "$pattern" <<<"$tests"; then
    echo "$ledger names $name, which is no test"
    missing=1
  fi
done <<<"$names"
[[ $named -gt 30 ]] || { echo "$ledger names $named tests only"; missing=1; }
exit "$missing"
