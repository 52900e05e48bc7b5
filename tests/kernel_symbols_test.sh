#!/usr/bin/env bash
# A kernel built for one instruction set must share no inline code with the rest of the program: the linker
# keeps one copy of each weak symbol, and a processor without that set would run into it.
# usage: kernel_symbols_test.sh OBJECT ISA
set -euo pipefail
shared=$(nm --demangle "$1" | awk '$2 ~ /^[WVuv]$/' | grep -v "$2::" || true)
if [[ -n $shared ]]; then
  printf 'weak symbols of %s that are not of %s alone:\n%s\n' "$1" "$2" "$shared"
  exit 1
fi
nm --demangle "$1" | grep " T .*run_lanes_$2" >/dev/null || { echo "$1 does not define run_lanes_$2"; exit 1; }
