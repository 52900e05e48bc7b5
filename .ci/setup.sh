# shellcheck shell=bash
# What cosys-sim, tests/run and .ci/run share: the Debian packages (packages.txt) and the builds.
# To be sourced with `root` = the top of the tree. It speaks on stderr only and never reads stdin.
: "${root:?}"

say() { echo "cosys-sim: $*" >&2; }

fail() { # PROBLEM (WHY) SUGGESTION; 3 = the environment failed
  say "$@"
  exit 3
}

# with_lock COMMAND...: two calls at once neither install nor build into each other.
with_lock() {
  mkdir -p "$root/build" 2>/dev/null || true
  [[ -w $root/build ]] ||
    fail "cannot write to $root/build (no permission, or the disk is full)" \
      "Use a copy of the tree that is yours, or COSYS_SKIP_SETUP=1 for the program as it is."
  (
    trap 'exit 130' INT
    if ! flock -n 9; then
      say "waiting for another build in $root/build"
      flock 9
    fi
    "$@"
  ) 9>"$root/build/.lock" </dev/null
}

# quietly LOG COMMAND...: its output is shown only when it fails.
quietly() {
  local log=$root/build/$1
  shift
  "$@" >"$log" 2>&1 && return
  local code=$?
  tail -n 100 "$log" >&2
  say "(all of it is in $log)"
  return "$code"
}

# --- packages ---------------------------------------------------------------------------------

packages_of() { # packages_of GROUP...
  local group package rest
  while read -r group package rest; do
    [[ " $* " == *" $group "* ]] && echo "$package"
  done <"$root/packages.txt"
  return 0
}

missing_packages() { # missing_packages GROUP...
  local wanted installed package
  mapfile -t wanted < <(packages_of "$@")
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null) || true
  for package in "${wanted[@]}"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed $package"$'\n'* ]] || echo "$package"
  done
}

as_root() {
  if [[ $EUID -eq 0 ]]; then "$@"; else sudo "$@"; fi
}

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@"
}

apt_install() { # the lists are fetched only where those at hand do not do
  local install=(install -y --no-install-recommends "$@")
  apt_get "${install[@]}" || { apt_get update && apt_get "${install[@]}"; }
}

building_takes() { # building_takes GROUP...: CPU seconds, of the program alone or of the tests too
  if [[ " $* " == *" test "* ]]; then echo 900; else echo 300; fi
}

install_missing() { # install_missing GROUP...
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [[ ${#missing[@]} -gt 0 ]] || return 0
  local by_hand="apt-get install --no-install-recommends ${missing[*]}"
  [[ $EUID -eq 0 ]] || command -v sudo >/dev/null ||
    fail "packages are missing (not root, and there is no sudo) As root: $by_hand"
  say "installing ${missing[*]}$([[ -d $root/build/release ]] || echo "; to build then takes $(minutes_for "$(building_takes "$@")")")"
  quietly install.log apt_install "${missing[@]}" ||
    fail "packages are missing (apt-get failed, see above) Install them by hand: $by_hand"
}

need_tools_without_apt() { # need_tools_without_apt GROUP...: the libraries are then for CMake to find
  local tool
  for tool in cmake ninja c++ pkg-config; do
    command -v "$tool" >/dev/null || fail "there is no $tool (and no apt-get here to install it)" \
      "Install what corresponds to these Debian packages:" "$(packages_of "$@" | paste -sd ' ')"
  done
}

need_packages() { # need_packages GROUP...
  if [[ ${COSYS_SKIP_SETUP:-0} == 1 ]]; then
    return
  elif ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    need_tools_without_apt "$@"
  elif [[ -n $(missing_packages "$@") ]]; then
    with_lock install_missing "$@"
  fi
}

# --- builds -----------------------------------------------------------------------------------

build_jobs() { # one per core, as long as each has 1.5 GB of memory: Eigen and TOML++ are heavy to compile
  local cores memory_kb limit
  cores=$(nproc)
  memory_kb=$(awk '/^MemAvailable/ {print $2}' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null) || limit=max
  [[ $limit == max || $limit -ge $((memory_kb * 1024)) ]] || memory_kb=$((limit / 1024))
  local fit=$((memory_kb / 1500000))
  echo $((fit < 1 ? 1 : fit < cores ? fit : cores))
}

is_set_up() { # is_set_up DIR: not by a configuration cut short, nor for a tree that has moved since
  [[ $1/build.ninja -nt $1/CMakeCache.txt ]] && has_settings "$1" "CMAKE_HOME_DIRECTORY:INTERNAL=$root"
}

has_settings() { # has_settings DIR NAME:TYPE=VALUE...
  local setting
  for setting in "${@:2}"; do
    grep -qxF "$setting" "$1/CMakeCache.txt" || return
  done
}

kept_settings() { # kept_settings DIR: those that a configuration from scratch would forget
  sed -nE 's/^(COSYS_(TESTS|WERROR):BOOL=.*)/\1/p' "$1/CMakeCache.txt"
}

# What CMake may have looked for in vain, or found in another version: packages and uPlot. A preset that changed
# asks for a configuration from scratch too.
state_of_packages() {
  local names=()
  cksum "$root/CMakePresets.json"
  mapfile -t names < <(packages_of build test lint optional)
  dpkg-query -W -f='${Package} ${Version} ${db:Status-Status}\n' "${names[@]}" 2>/dev/null || true
  [[ ! -e $uplot ]] || echo "uPlot $(stat -c %Y "$uplot")"
}

uplot=$root/build/node_modules/uplot/dist/uPlot.iife.min.js

# Charts of reports are alive with uPlot; the program does without. Asked for once (npm.log).
need_uplot() {
  [[ ! -e $uplot && ! -e $root/build/npm.log ]] && command -v npm >/dev/null || return 0
  quietly npm.log npm install --prefix "$root/build" --no-audit --no-fund --fetch-retries=1 \
    --fetch-timeout=20000 uplot@1.6.32 || say "npm brought no uPlot (see above): charts in reports will stand still"
}

may_take_ccache() { # may_take_ccache DIR: found later, it would have all compiled again
  command -v ccache >/dev/null &&
    { ! is_set_up "$1" || grep -q '^CMAKE_CXX_COMPILER_LAUNCHER:.*=ccache$' "$1/CMakeCache.txt"; }
}

configure() { # configure PRESET [NAME:TYPE=VALUE]...
  local dir=$root/build/$1 settings=("${@:2}") fresh=() found=()
  need_uplot
  [[ ! -e $uplot ]] || found=("COSYS_UPLOT_SCRIPT:FILEPATH=$uplot")
  local kept=()
  if ! is_set_up "$dir"; then
    fresh=(--fresh)
  elif [[ $(state_of_packages) != "$(cat "$dir/.packages" 2>/dev/null)" ]]; then
    fresh=(--fresh) # a library not found stays not found otherwise
    mapfile -t kept < <(kept_settings "$dir")
    settings=("${kept[@]}" "${settings[@]}")
  elif has_settings "$dir" "${settings[@]}" "${found[@]}"; then
    return
  fi
  local with=()
  if may_take_ccache "$dir"; then with=(env CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  (cd "$root" && quietly "$1.log" "${with[@]}" cmake "${fresh[@]}" --preset "$1" "${settings[@]/#/-D}") &&
    state_of_packages >"$dir/.packages"
}

# ninja's own count on a terminal; elsewhere a line now and then, and what the compiler said only if it failed.
run_ninja() { # run_ninja PRESET TARGET
  local ninja=(ninja -C "$root/build/$1" -j "$(build_jobs)" "$2") log=$root/build/$1.log
  if [[ -t 2 ]]; then
    "${ninja[@]}" >&2
    return
  fi
  quietly "$1.log" "${ninja[@]}" &
  local build=$! seconds=0
  while kill -0 "$build" 2>/dev/null; do
    sleep 0.2
    seconds=$((seconds + 1))
    ((seconds % 150 != 0)) || say "building: $(tail -n 1 "$log" | grep -oE '^\[[0-9/]+\]' || echo "...")"
  done
  wait "$build"
}

run_ctest() { # run_ctest PRESET JOBS [ctest argument]...
  (cd "$root" && ctest --preset "$1" --no-tests=error -j "$2" "${@:3}")
}

minutes_for() { # minutes_for CPU_SECONDS: in words, on this machine
  local jobs
  jobs=$(build_jobs)
  echo "about $((($1 / jobs + 59) / 60)) min on $jobs core$([[ $jobs == 1 ]] || echo s)"
}

build() { # build PRESET TARGET [NAME:TYPE=VALUE]...: brings the target up to date
  configure "$1" "${@:3}" || fail "the build could not be set up (see above)" \
    "Are these installed? $(packages_of build test | paste -sd ' ')"
  run_ninja "$1" "$2" ||
    fail "the build failed (see above) Run 'ninja -C $root/build/$1 $2' to try again."
}

program_is_fresh() { # a cheap stand-in for asking ninja; folders count, so files that came and went do too
  local sources=(CMakeLists.txt CMakePresets.json dsp channel protocol sim .git/logs/HEAD)
  [[ -x $program && -e $root/build/release/.program ]] &&
    [[ -z $(cd "$root" && find "${sources[@]}" -newer build/release/.program -print -quit 2>/dev/null) ]]
}

build_program() {
  program_is_fresh && return # another call may have built it while this one waited
  local settings=()
  # The program alone needs no test packages; a tree where the tests are on keeps them.
  is_set_up "$root/build/release" || settings=(COSYS_TESTS:BOOL=OFF)
  say "building$([[ -x $program ]] || echo ": the first time takes $(minutes_for "$(building_takes build)")")"
  touch "$root/build/.began"
  build release cosys-sim "${settings[@]}"
  mv "$root/build/.began" "$root/build/release/.program"
}

need_program() { # sets `program`
  program=$root/build/release/bin/cosys-sim
  program_is_fresh || with_lock build_program
}
