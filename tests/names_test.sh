#!/usr/bin/env bash
# Two types of one name in a namespace that files share are one to the linker, whichever it keeps: a
# vector of one then grows as a vector of the other, and no compiler says so. So each has its own.
# Usage: names_test.sh [TREE]; exits 1 naming both places.
set -euo pipefail
tree=${1:-$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")}
cd "$tree"

# A namespace is a folder at the top; each program of tests/ has names of its own. Nested types and
# specialisations (Name::, Name<) belong to the type before.
# shellcheck disable=SC2016 # the $ are those of awk
find dsp channel protocol sim tests -name '*.[ch]pp' -print | sort | xargs -r -d '\n' \
  awk '
    FNR == 1 { hidden = 0 }
    /^namespace \{/ { hidden = 1 }
    /^}  \/\/ namespace$/ { hidden = 0 }
    !hidden && match($0, /^(struct|class|enum class|union) [A-Za-z_0-9]+[^;]*\{/) {
      name = $0
      sub(/^(struct|class|enum class|union) /, "", name)
      if (name ~ /^[A-Za-z_0-9]+(::|<)/) next
      sub(/[^A-Za-z_0-9].*/, "", name)
      folder = FILENAME
      sub(folder ~ /^tests\// ? "/[^/]*$" : "/.*", "", folder)
      if ((folder, name) in place) {
        print FILENAME ":" FNR ": " name " is the name of the type at " place[folder, name] " too"
        bad = 1
      }
      place[folder, name] = FILENAME ":" FNR
    }
    END { exit bad }'
