#!/usr/bin/env bash
# The pictures that README.md shows are those that the program draws now.
# Usage: pictures_test.sh PROGRAM SOURCES [--write]; exits 1 saying which is another. With --write they are drawn anew.
set -euo pipefail
program=$(readlink -f "$1") sources=$(readlink -f "$2")
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT
cd "$drawn"

"$program" trace "$sources/scenarios/quickstart.toml" --point 6 --trial 0 -o trial.svg >/dev/null
"$program" run "$sources/scenarios/choose_module.toml" -q -n 40 -o modules.h5 \
  --set receiver.module=TSSP4056,TSOP4156,TSOP31156,TSOP4856,TSOP38256,TSOP4456 \
  --set receiver.range_m=0.5,1,1.5,2,2.5,3,4,6,8,11,14 >/dev/null
"$program" report modules.h5 --svg all -o modules.html >/dev/null
mv all/how-far-each-reaches.svg modules.svg

code=0
for picture in trial modules; do
  if [[ ${3-} == --write ]]; then
    cp "$picture.svg" "$sources/tests/pictures/"
  elif ! cmp "$picture.svg" "$sources/tests/pictures/$picture.svg"; then
    echo "tests/pictures/$picture.svg is not what the program draws now: tests/pictures_test.sh $* --write"
    code=1
  fi
done
exit "$code"
