#!/usr/bin/env bash
# Proves that layering_test.sh can fail: in a tree made for it, each include below is allowed or caught.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
wrong=0

said_of() { # said_of FILE LINE: what the test says of a tree with that line in the file
  rm -rf "${tree:?}"/*
  mkdir -p "$tree"/{dsp,channel,protocol,sim} "$tree/$(dirname "$1")"
  printf '// a comment\n%s\n' "$2" >"$tree/$1"
  "$here/layering_test.sh" "$tree"
}

expect_line() { # expect_line allowed|caught FILE LINE
  local found=allowed said
  said=$(said_of "$2" "$3") || found=caught
  [[ $found == "$1" ]] || { echo "$2: $3 should be $1, is $found"; wrong=1; }
  [[ $found == allowed || $said == "$2:2: "* ]] || { echo "$2:2 is not named in: $said"; wrong=1; }
}

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
expect_line allowed sim/result/hdf5_answers.cpp 'H5Fopen(path, 0, 0);'
expect_line caught sim/result/netcdf.cpp 'H5Fopen(path, 0, 0);'
expect_line caught sim/engine/resume.cpp '  H5Fis_hdf5(path);'
exit "$wrong"
