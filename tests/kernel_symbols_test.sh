#!/usr/bin/env bash
# A kernel built for one instruction set must share no inline code with the rest of the program: the linker
# keeps one copy of each weak symbol, and a processor without that set would run into it.
# usage: kernel_symbols_test.sh ISA "KERNEL..." OBJECT...
set -euo pipefail
isa=$1 kernels=$2
shift 2
for object; do
  shared=$(nm --demangle "$object" | awk '$2 ~ /^[WVuv]$/' | grep -v "$isa::" || true)
  if [[ -n $shared ]]; then
    printf 'weak symbols of %s that are not of %s alone:\n%s\n' "$object" "$isa" "$shared"
    exit 1
  fi
done
for kernel in $kernels; do
  nm --demangle "$@" | grep " T .*${kernel}_$isa" >/dev/null || { echo "no object defines ${kernel}_$isa"; exit 1; }
done
