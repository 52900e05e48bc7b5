#!/usr/bin/env bash
# The one-way flow of the folders, read off every #include: dsp knows nobody, channel and protocol know
# dsp and not each other, sim knows all. A library from outside is named only where `rules` says.
# Usage: layering_test.sh [TREE]; exits 1 naming file, line and what may not be.
set -euo pipefail
tree=${1:-$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")}
cd "$tree"

# What is included (a pattern for the whole name), and the files that may (a pattern for the whole path).
# Standard C++ headers, which have neither dot nor slash, are free to all.
rules='
dsp/.*               (dsp|channel|protocol|sim)/.*
channel/.*           (channel|sim)/.*
protocol/.*          (protocol|sim)/.*
sim/.*               sim/.*
immintrin[.]h        dsp/.*
fftw3[.]h            dsp/spectrum[.]cpp
Eigen/.*             channel/(.*[.]cpp|bump[.]hpp)|dsp/truncated_orthant[.][ch]pp|sim/(importance_link|(matched_|module_)?proposal|peak_readings|trial_noise)[.][ch]pp
armadillo            sim/.*[.]cpp
hdf5.*[.]h|H5.*[.]h  sim/(netcdf[.]cpp|hdf5_handle[.]hpp)
toml[+][+]/.*        sim/entries[.]cpp
CLI/.*               sim/command_(line|options)[.].pp
(fmt|nlohmann)/.*    sim/.*[.]cpp
boost/.*             sim/.*[.]cpp
xxhash[.]h           sim/.*[.]cpp
(sys/)?[a-z]+[.]h    sim/.*
'

# shellcheck disable=SC2016 # the $ are those of awk
find dsp channel protocol sim -name '*.[ch]pp' -print | sort | xargs -r -d '\n' \
  awk -v rules="$rules" '
    BEGIN {
      n = split(rules, line, "\n")
      for (i = 1; i <= n; ++i)
        if (split(line[i], field, " ") == 2) { ++count; what[count] = field[1]; who[count] = field[2] }
    }
    function matches(text, pattern) { return text ~ ("^(" pattern ")$") }
    function may_include(file, name,   i) {
      for (i = 1; i <= count; ++i)
        if (matches(name, what[i])) return matches(file, who[i])  # the first rule that fits decides
      return 0
    }
    match($0, /^[ \t]*#[ \t]*include[ \t]*[<"][^>"]*/) {
      name = substr($0, RSTART, RLENGTH)
      quote = index(name, "<") ? "<" : "\""
      name = substr(name, index(name, quote) + 1)
      if (quote == "<" && name ~ /^[a-z_0-9]+$/ && name != "armadillo") next
      if (may_include(FILENAME, name)) next
      printf "%s:%d: %s may not include %s\n", FILENAME, FNR, FILENAME, name
      bad = 1
    }
    END { exit bad }'
