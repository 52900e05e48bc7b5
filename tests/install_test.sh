#!/usr/bin/env bash
# An installed program, run in a folder of its own: it has its parts, its quickstart, and the user's scenario.
# usage: install_test.sh BUILD_FOLDER
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
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
! "$program" run mine.toml --set receiver.module=nobody 2>error.txt || fail 'a module that nobody has was found'
grep -qF "$shared/modules" error.txt || fail 'its own modules are not looked for:' "$(cat error.txt)"

# What the program wrote of itself: a manual page with all commands, and what shells complete.
share=$folder/installed/share
mapfile -t commands < <("$program" --help | sed -n '/^Commands:/,$s/^  \([a-z]\+\) .*/\1/p')
[[ ${#commands[@]} -gt 10 ]] || fail 'the help names too few commands:' "${commands[@]}"
for command in "${commands[@]}"; do
  grep -qx "\.SS $command" "$share/man/man1/cosys-sim.1" || fail "$command is not in the manual page"
done
words=$(bash --norc -c 'source "$1"; COMP_WORDS=(cosys-sim decode --uart mid) COMP_CWORD=3; _cosys_sim
  echo "${COMPREPLY[@]}"' bash "$share/bash-completion/completions/cosys-sim")
[[ $words == mid-bit ]] || fail "bash makes this of decode --uart mid: $words"
[[ -s $share/libsigrokdecode/decoders/cosys/pd.py ]] || fail 'sigrok would not find the decoder'
# shellcheck disable=SC2016 # the $ are those of zsh, at whose terminal somebody presses the tabulator
press_tab='
  zmodload zsh/zpty
  zpty shell zsh -f -i
  zpty -w shell "PS1=; fpath=($1 \$fpath); autoload -U compinit; compinit -u -D; echo re\"\"ady"
  zpty -r -m shell seen "*ready*"
  zpty -w -n shell "cosys-sim $2'$'\t''"
  zpty -r -m shell seen "*mid-bit*"'
command -v zsh >/dev/null || "$here/skip.sh" install "needs zsh (Debian: zsh)" || exit $?
for words in 'decode --uart mid' 'run --set uart.receiver=mid' 'run --set=uart.receiver=mid'; do
  timeout 30 zsh -f -c "$press_tab" zsh "$share/zsh/site-functions" "$words" || fail "zsh does not complete $words"
done
command -v fish >/dev/null || "$here/skip.sh" install "needs fish (Debian: fish)" || exit $?
words=$(PATH=$folder/installed/bin:$PATH XDG_DATA_DIRS=$share HOME=$folder \
  fish -c 'complete -C "cosys-sim decode --uart mid"')
[[ $words == mid-bit* ]] || fail "fish makes this of decode --uart mid: $words"
