#!/usr/bin/env bash
# Proves that layering_test.sh can fail: of two trees made for it, it allows each line of the one and names each of the
# other. Those before a call of `judge` are looked at together, and those of one file stand one below the other.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
trees=$(mktemp -d)
trap 'rm -rf "$trees"' EXIT
wrong=0

declare -A lines # of a file so far

expect_line() { # expect_line allowed|caught FILE LINE
  local file=$trees/$1/$2
  [[ -d ${file%/*} ]] || mkdir -p "${file%/*}"
  [[ -n ${lines[$file]:-} ]] || { echo '// a comment' >"$file" && lines[$file]=1; }
  echo "$3" >>"$file"
  lines[$file]=$((lines[$file] + 1))
  [[ $1 == allowed ]] || echo "$2:${lines[$file]}:" >>"$trees/to_name"
}

begin() {
  lines=()
  mkdir -p "$trees"/{allowed,caught}/{dsp,channel,protocol,sim}
}

judge() {
  local said
  said=$("$here/layering_test.sh" "$trees/allowed") || { printf 'should be allowed:\n%s\n' "$said"; wrong=1; }
  ! said=$("$here/layering_test.sh" "$trees/caught") || { echo 'nothing is caught'; wrong=1; }
  diff <(sort "$trees/to_name") <(cut -d ' ' -f 1 <<<"$said" | sort) || { echo '< is not named, > should not be'; wrong=1; }
  rm -rf "${trees:?}"/*
  begin
}

begin
expect() { expect_line "$1" "$2" "#include $3"; } # expect allowed|caught FILE INCLUDE

expect allowed dsp/a.hpp '<vector>'
expect allowed dsp/a.cpp '"dsp/units.hpp"'
expect allowed channel/a.hpp '"dsp/units.hpp"'
expect allowed protocol/a.cpp '"protocol/uart.hpp"'
expect allowed sim/a.hpp '"channel/floor.hpp"'
expect allowed sim/a.cpp '"protocol/uart.hpp"'
expect caught dsp/a.cpp '"channel/floor.hpp"'
expect caught dsp/a.cpp '"sim/failure.hpp"'
expect caught channel/a.cpp '"protocol/uart.hpp"'
expect caught protocol/a.hpp '"channel/floor.hpp"'
expect caught protocol/a.hpp '"sim/failure.hpp"'
expect caught channel/a.cpp '<sim/failure.hpp>'
expect caught sim/a.cpp '"failure.hpp"'
expect caught sim/a.cpp '"../dsp/units.hpp"'

expect allowed sim/link/a.cpp '"sim/scenario/scenario.hpp"'
expect allowed sim/link/a.cpp '"sim/link/link.hpp"'
expect allowed sim/text/a.cpp '"sim/failure.hpp"'
expect allowed sim/main.cpp '"sim/command/command_line.hpp"'
expect caught sim/scenario/a.hpp '"sim/link/link.hpp"'
expect caught sim/failure.cpp '"sim/text/number_text.hpp"'
expect caught sim/unlisted/a.cpp '"sim/text/number_text.hpp"'

expect allowed dsp/spectrum.cpp '<fftw3.h>'
expect allowed channel/geometry.cpp '<Eigen/Dense>'
expect allowed dsp/truncated_orthant.hpp '<Eigen/Core>'
expect allowed sim/trial/proposal.cpp '<Eigen/Core>'
expect allowed sim/result/netcdf.cpp '<hdf5.h>'
expect allowed sim/result/netcdf.cpp '<hdf5_hl.h>'
expect allowed sim/scenario/entries.cpp '<toml++/toml.h>'
expect allowed sim/command/command_line.cpp '<CLI/CLI.hpp>'
expect allowed sim/result/curve_fit.cpp '<armadillo>'
expect allowed sim/main.cpp '<sys/stat.h>'
expect caught dsp/spectrum.hpp '<fftw3.h>'
expect caught dsp/philox.cpp '<fftw3.h>'
expect caught channel/geometry.hpp '<Eigen/Dense>'
expect caught dsp/philox.cpp '<Eigen/Core>'
expect caught sim/trial/trial.cpp '"Eigen/Dense"'
expect caught sim/counting/tally.cpp '<hdf5.h>'
expect caught sim/result/store.cpp '<hdf5.h>'
expect caught sim/result/netcdf.hpp '<H5public.h>'
expect caught sim/trial/trial.cpp '<toml++/toml.h>'
expect caught sim/engine/plan.cpp '<CLI/CLI.hpp>'
expect caught sim/counting/statistics.hpp '<boost/math/distributions/beta.hpp>'
expect caught sim/failure.hpp '<fmt/format.h>'
expect caught protocol/a.cpp '<nlohmann/json.hpp>'
expect caught sim/counting/statistics.hpp '<armadillo>'
expect caught sim/a.cpp '<somebody/elses.hpp>'

expect allowed sim/result/hdf5_answers.hpp '"sim/result/hdf5_handle.hpp"'
expect allowed sim/result/reading_process.cpp '"sim/result/hdf5_answers.hpp"'
expect caught sim/result/reading_process.hpp '"sim/result/hdf5_answers.hpp"'
expect caught sim/result/netcdf_reader.cpp '"sim/result/hdf5_handle.hpp"'
expect caught sim/result/netcdf_reader.cpp '"sim/result/hdf5_answers.hpp"'
judge

expect_line allowed sim/result/hdf5_answers.cpp 'H5Fopen(path, 0, 0);'
expect_line caught sim/result/netcdf.cpp 'H5Fopen(path, 0, 0);'
expect_line caught sim/engine/resume.cpp '  H5Fis_hdf5(path);'
judge
exit "$wrong"
