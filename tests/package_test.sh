#!/usr/bin/env bash
# The Debian package, made of a build, installed and run where there is nothing but what it depends on: a library
# without a package in Depends is then missing. Nothing is fetched; the packages' files are those of this machine.
# usage: package_test.sh BUILD_FOLDER [PACKAGE.deb]
set -euo pipefail
export LC_ALL=C PATH=$PATH:/usr/sbin:/sbin
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
root=$folder/root

fail() { printf '%s\n' "$@" >&2; exit 1; }
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
skip() { "$here/skip.sh" package "$*" || exit $?; }
need() { command -v "$1" >/dev/null || skip "needs $1 (Debian: $2)"; }
need cpack cmake
need dpkg-shlibdeps dpkg-dev
need file file

# --- the package ------------------------------------------------------------------------------

make_package() { # make_package BUILD_FOLDER: compressed fast, not well
  cpack --config "$1/CPackConfig.cmake" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip -B "$folder/made" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
  echo "$folder"/made/*.deb
}

expect_field() { # expect_field NAME PATTERN
  local value
  value=$(dpkg-deb --field "$package" "$1")
  [[ $value =~ $2 ]] || fail "$1: $value" "expected: $2"
}

package=${2:-$(make_package "$1")}
[[ -s $package ]] || fail "cpack made no package"
[[ ${package##*/} =~ ^cosys-sim_[0-9.]+_$(dpkg --print-architecture)\.deb$ ]] || fail "a strange name: $package"
expect_field Package '^cosys-sim$'
expect_field Version '^[0-9]+\.[0-9]+\.[0-9]+$'
expect_field Section '^science$'
expect_field Maintainer '^cosys-sim developers'
expect_field Depends 'libc6 .*libhdf5'
expect_field Description '59 kHz'

dpkg-deb --contents "$package" >"$folder/contents"
expect_file() { # expect_file MODE PATH: as tar lists them; the path may end in " -> TARGET"
  awk -v mode="$1" -v path="./usr/$2" '
    { name = $6; for (i = 7; i <= NF; ++i) name = name " " $i }
    $1 == mode && $2 == "root/root" && name == path { found = 1 }
    END { exit !found }' "$folder/contents" || fail "not in the package: $1 $2" "$(cat "$folder/contents")"
}
expect_file -rwxr-xr-x bin/cosys-sim
for file in cosys-sim/quickstart.toml cosys-sim/modules/tsop4856.toml cosys-sim/sigrok/cosys/pd.py \
  man/man1/cosys-sim.1.gz bash-completion/completions/cosys-sim zsh/vendor-completions/_cosys-sim \
  fish/vendor_completions.d/cosys-sim.fish \
  doc/cosys-sim/copyright doc/cosys-sim/README.md doc/cosys-sim/protocol/PROTOCOLS.md doc/cosys-sim/CHANGELOG.md.gz; do
  expect_file -rw-r--r-- "share/$file"
done
expect_file lrwxrwxrwx 'share/libsigrokdecode/decoders/cosys -> ../../cosys-sim/sigrok/cosys'
! grep -E 'CMakeLists|__pycache__|/include/|\.a$' "$folder/contents" || fail 'the package has these too'

# --- a root that holds what it depends on -----------------------------------------------------

# Names of packages; those that depend on nothing else first. Of alternatives the one that is here.
closure_of() { # closure_of DEPENDS
  dpkg-query --show --showformat '${Package}\t${db:Status-Status}\t${Architecture}\t${Provides}\t${Pre-Depends}, ${Depends}\n' |
    awk -F '\t' -v first="$1" -v here="$(dpkg --print-architecture)" '
      function bare(name) { gsub(/[ (:].*/, "", name); return name }
      function want(depends,   group, choice, n, m, i, j, name, found) {
        n = split(depends, group, / *, */)
        for (i = 1; i <= n; ++i) {
          m = split(group[i], choice, / *[|] */)
          found = m == 0
          for (j = 1; j <= m && !found; ++j) {
            name = bare(choice[j])
            if (!(name in needs) && name in provider) name = provider[name]
            if (!(name in needs)) continue
            found = 1
            if (name in wanted) continue
            wanted[name] = 1
            want(needs[name])
            print name
          }
          if (!found) { print "not installed here: " group[i] > "/dev/stderr"; bad = 1 }
        }
      }
      $2 == "installed" && ($3 == here || $3 == "all") {
        needs[$1] = $5
        n = split($4, names, / *, */)
        for (i = 1; i <= n; ++i) provider[bare(names[i])] = $1
      }
      END { want(first); exit bad }'
}

copy_packages() { # copy_packages PACKAGE...: files and what dpkg knows of them
  local name link target
  for name in bin lib lib32 lib64 libx32 sbin; do
    [[ ! -L /$name ]] || { mkdir -p "$root/usr/$name" && cp -P "/$name" "$root/"; }
  done
  mkdir -p "$root"/var/lib/dpkg/{info,updates,triggers}
  for name; do
    for list in "/var/lib/dpkg/info/$name.list" "/var/lib/dpkg/info/$name:$(dpkg --print-architecture).list"; do
      [[ ! -e $list ]] || cp "$list" "$root/var/lib/dpkg/info/"
    done
  done
  cat "$root"/var/lib/dpkg/info/*.list | sed 's|^/||' | grep -vE '^(\.?$|usr/share/(doc|man|locale|info)/)' | sort -u |
    tar -C / --no-recursion --ignore-failed-read -cf - -T - 2>/dev/null | tar -C "$root" --keep-directory-symlink -xf -
  awk -v names=" $* " -v here="$(dpkg --print-architecture)" 'BEGIN { RS = ""; ORS = "\n\n" }
    match($0, /(^|\n)Package: [^\n]*/) {
      name = substr($0, RSTART, RLENGTH); sub(/.*Package: /, "", name)
      if (index(names, " " name " ") && $0 ~ "\nArchitecture: (all|" here ")\n") print
    }' /var/lib/dpkg/status >"$root/var/lib/dpkg/status"
  # Links that a package sets as it is configured: a BLAS out of several.
  for name in /var/lib/dpkg/alternatives/*.so.*; do
    link=$(sed -n 2p "$name")
    for target in $(update-alternatives --list "${name##*/}"); do
      [[ ! -e $root$target || -L $root$link ]] || ln -s "$target" "$root$link"
    done
  done
}

closure=$(closure_of "$(dpkg-deb --field "$package" Depends)") || fail 'its Depends cannot be met here'
chroot / true 2>/dev/null || skip 'needs root, to run in a root of its own: the package itself is as it should be'
mkdir -p "$root"/{dev,proc/self,tmp}
mapfile -t packages <<<"$closure"
copy_packages "${packages[@]}"

# --- installed, run, removed ------------------------------------------------------------------

dpkg --root="$root" --install "$package" >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
[[ -z $(dpkg --root="$root" --verify cosys-sim) ]] || fail "$(dpkg --root="$root" --verify cosys-sim)"
[[ -s $root/usr/share/libsigrokdecode/decoders/cosys/pd.py ]] || fail 'sigrok would not find the decoder'
copyright=$root/usr/share/doc/cosys-sim/copyright
grep -q '^License: GPL-3+' "$copyright" || fail 'no licence'
! grep -q 'leeoniya/uPlot' "$root/usr/bin/cosys-sim" || grep -q 'Leon Sorokin' "$copyright" || fail 'no notice of uPlot'

# It finds its parts by its own place, which /proc would say.
ln -s /usr/bin/cosys-sim "$root/proc/self/exe"
inside() { # inside ARGUMENT...
  env -i "$(command -v chroot)" "$root" /usr/bin/cosys-sim "$@" >"$folder/out" 2>&1 || fail "cosys-sim $* failed:" "$(cat "$folder/out")"
}
inside --version
inside parts
grep -q TSOP4856 "$folder/out" || fail 'it has no parts:' "$(cat "$folder/out")"
inside run /usr/share/cosys-sim/quickstart.toml -n 8 -q -o /tmp/quickstart.h5
grep -q digest "$folder/out" || fail 'no results:' "$(cat "$folder/out")"
inside report /tmp/quickstart.h5 -o /tmp/report.html
[[ -s $root/tmp/report.html ]] || fail 'no report'

dpkg --root="$root" --remove cosys-sim >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
! find "$root/usr" -name '*cosys*' | grep . || fail 'it left these behind'
echo "ran with ${#packages[@]} packages: ${packages[*]}"
