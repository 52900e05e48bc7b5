#!/usr/bin/env bash
# An installed program, run in a folder of its own: it has its parts, its quickstart, and the user's scenario.
# usage: install_test.sh BUILD_FOLDER
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/installed" >"$folder/log"
mkdir "$folder/elsewhere"
cd "$folder/elsewhere"
program=$folder/installed/bin/cosys-sim
shared=$folder/installed/share/cosys-sim

fail() { printf '%s\n' "$@"; exit 1; }
# A user's part beside the scenario, and one that the program brings.
mkdir leds
sed 's/^name = .*/name = "MINE"/' "$shared/leds/tsal6200.toml" >leds/mine.toml
printf '[receiver]\nmodule = "TSOP4856"\n[led]\npart = "MINE"\n[stop]\nmax_frames = 1\n' >mine.toml
"$program" run mine.toml --quiet >table.txt
"$program" run "$shared/quickstart.toml" --quiet --set receiver.range_m=1 -n 1 >>table.txt
[[ -s mine.h5 && -s quickstart.h5 ]] || fail 'no result file' "$(cat table.txt)"
! "$program" run mine.toml --set receiver.module=none 2>error.txt || fail 'a module that nobody has was found'
grep -qF "$shared/modules" error.txt || fail 'its own modules are not looked for:' "$(cat error.txt)"
