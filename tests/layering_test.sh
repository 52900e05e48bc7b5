#!/usr/bin/env bash
# The one-way flow of the folders, read off every #include: dsp knows nobody, channel and protocol know
# dsp and not each other, sim knows all. Within sim a folder knows those before it in `sim_order` alone.
# A library from outside is named only where `rules` says. HDF5 files are opened for reading in one place, which
# a process of its own uses (sim/result/reading_process.hpp), as the library falls over some damaged ones.
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
sim/result/hdf5_handle.hpp   sim/result/(netcdf[.]cpp|hdf5_answers[.][ch]pp)
sim/result/hdf5_answers.hpp  sim/result/(hdf5_answers|reading_process)[.]cpp
sim/.*               sim/.*
immintrin[.]h        dsp/.*
fftw3[.]h            dsp/spectrum[.]cpp
Eigen/.*             channel/(.*[.]cpp|bump[.]hpp)|dsp/truncated_orthant[.][ch]pp|sim/(link/importance_link|noise/.*|trial/.*proposal)[.][ch]pp
armadillo            sim/.*[.]cpp
hdf5.*[.]h|H5.*[.]h  sim/result/(netcdf[.]cpp|hdf5_answers[.]cpp|hdf5_handle[.]hpp)
toml[+][+]/.*        sim/scenario/entries[.]cpp
CLI/.*               sim/command/(command_line|commands_added|read_usage|.*_options)[.].pp
nlohmann/json_fwd[.]hpp      sim/(result/(axis|unit_spread)_json|text/(json_answer|row_table))[.]hpp
(fmt|nlohmann)/.*    sim/.*[.]cpp
boost/.*             sim/.*[.]cpp
cereal/.*            sim/engine/checkpoint_bytes[.]hpp
xxhash[.]h           sim/.*[.]cpp
pugixml[.]hpp        sim/.*[.]cpp
(zip|sndfile)[.]h    sim/(capture|trace|check)/.*[.]cpp
openssl/.*           sim/(page|trace)/.*[.]cpp
(sys/)?[a-z]+[.]h    sim/.*
'

# Files in sim itself are known to all, but main.cpp, which knows all.
sim_order='threads text picture noise counting scenario components link loading trial result engine columns section
           link_experiment false_accepts capture arena guard shared_link location trace report page serial check node
           serve fit command'

# shellcheck disable=SC2016 # the $ are those of awk
find dsp channel protocol sim -name '*.[ch]pp' -print | sort | xargs -r -d '\n' \
  awk -v rules="$rules" -v sim_order="$(tr '\n' ' ' <<< "$sim_order")" '
    BEGIN {
      n = split(rules, line, "\n")
      for (i = 1; i <= n; ++i)
        if (split(line[i], field, " ") == 2) { ++count; what[count] = field[1]; who[count] = field[2] }
      n = split(sim_order, folder, " ")
      for (i = 1; i <= n; ++i) rank["sim/" folder[i]] = i
    }
    function folder_of(path) { sub("/[^/]*$", "", path); return path }
    function is_in_order(file, name) {
      if (name !~ "^sim/" || file == "sim/main.cpp" || folder_of(name) == "sim") return 1
      return folder_of(name) in rank && rank[folder_of(name)] <= rank[folder_of(file)]
    }
    function matches(text, pattern) { return text ~ ("^(" pattern ")$") }
    function may_include(file, name,   i) {
      for (i = 1; i <= count; ++i)
        if (matches(name, what[i]))  # the first rule that fits decides
          return matches(file, who[i]) && is_in_order(file, name)
      return 0
    }
    /H5F(open|reopen|mount|is_hdf5|is_accessible)/ && FILENAME != "sim/result/hdf5_answers.cpp" {
      printf "%s:%d: %s may not open an HDF5 file\n", FILENAME, FNR, FILENAME
      bad = 1
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
