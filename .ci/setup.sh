# shellcheck shell=sh disable=SC2154,SC2034
# Shared by ./dem-report and tests/run: Debian packages and the build folder. Sourced, with $root set.

# What a bare Debian 12 needs to build and to run, and what the tests need besides.
packages="g++ cmake ninja-build pkg-config libvtk9-dev libopenmpi-dev libosmesa6-dev libglew-dev libpng-dev libhdf5-dev
libtomlplusplus-dev libcxxopts-dev libfmt-dev nlohmann-json3-dev libkainjow-mustache-dev
libboost-dev libeigen3-dev libssl-dev librandom123-dev
weasyprint fonts-dejavu-core"
test_packages="doctest-dev tidy poppler-utils clang-format python3-jsonschema python3-junitparser libxml2-utils
mandoc man-db zsh fish"
# For test_slurm, which is skipped where these cannot be had.
cluster_packages="slurmctld slurmd slurm-client munge"
# Commands that look at pages in a browser, with their packages. Tests that need them are skipped without them.
browser_packages="chromium:chromium node:nodejs npm:npm"
build="$root/build"
lock="$root/.build.lock" # beside the build folder, which may have to be removed under it
jobs=$(nproc 2>/dev/null || echo 2)

say() { echo "$(basename -- "$0"): $*" >&2; }

# stop LOG MESSAGE: the end of the log, where the whole of it is, and exit code 3
stop() {
  [ ! -s "$1" ] || tail -n 40 "$1" >&2
  say "$2 (the whole log: $1)"
  exit 3
}

# missing_packages LIST
missing_packages() {
  # shellcheck disable=SC2086 # the list is meant to be split
  dpkg-query -W -f='${Package} ${Status}\n' $1 2>/dev/null |
    awk -v wanted="$1" '
      / install ok installed$/ { have[$1] = 1 }
      END {
        n = split(wanted, names)
        for (i = 1; i <= n; i++) if (!(names[i] in have)) printf "%s ", names[i]
      }'
}

# install_packages LIST
install_packages() {
  command -v dpkg-query >/dev/null 2>&1 || return 0 # not Debian: CMake says what it does not find
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || return 0
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
      as_root="sudo -n"
    else
      say "Debian packages are missing. Please run this line, then start again:"
      echo "sudo apt-get update && sudo apt-get install -y --no-install-recommends $missing" >&2
      exit 3
    fi
  fi
  say "installing Debian packages (once): $missing"
  log="$build/packages.log"
  # shellcheck disable=SC2086 # no word when root, two with sudo
  {
    $as_root apt-get -q -o Acquire::Retries=3 update &&
      $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 install \
        --no-install-recommends $missing
  } >"$log" 2>&1 </dev/null || stop "$log" "the packages could not be installed"
}

# try_packages LIST: as install_packages, where that needs no question; tests that want them skip without
try_packages() {
  command -v dpkg-query >/dev/null 2>&1 && [ "$(id -u)" -eq 0 ] || return 0
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || return 0
  say "installing Debian packages (once): $missing"
  # shellcheck disable=SC2086 # the list is meant to be split
  {
    apt-get -q -o Acquire::Retries=3 update &&
      DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 install --no-install-recommends $missing
  } >"$build/cluster-packages.log" 2>&1 </dev/null || say "they could not be installed; test_slurm is skipped"
}

# install_if_possible "COMMAND:PACKAGE ...": those whose command is missing; a word where that fails, and no end
install_if_possible() {
  wanted=
  for one in $1; do command -v "${one%%:*}" >/dev/null 2>&1 || wanted="$wanted ${one##*:}"; done
  [ -n "$wanted" ] || return 0
  (install_packages "$wanted") || say "going on without$wanted"
}

# configure OPTION...: makes or refreshes the build folder
configure() {
  log="$build/configure.log"
  cmake -S "$root" -B "$build" -G Ninja "$@" >"$log" 2>&1 </dev/null || stop "$log" "CMake could not configure"
}

# build_targets LOG TARGET...
build_targets() {
  log="$1"
  shift
  cmake --build "$build" -j "$jobs" --target "$@" >"$log" 2>&1 </dev/null || stop "$log" "the build failed"
}

# take_turn: one at a time, the second waits for the first; held as descriptor 9. Where no lock can be made, on a disk that
# cannot be written, nothing can be built either.
take_turn() {
  command -v flock >/dev/null 2>&1 || return 0
  (umask 022 && : >>"$lock") 2>/dev/null || :
  if [ -r "$lock" ]; then
    exec 9<"$lock"
    flock 9 || :
  fi
}

# A copied or moved clone brings a build folder that belongs elsewhere.
build_is_ours() {
  [ ! -f "$build/CMakeCache.txt" ] || grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"
}

# built_by_another: somebody else built here, and we may not; true when their program is there and newer than its sources.
built_by_another() {
  [ -d "$build" ] && [ ! -w "$build" ] || return 1
  if [ -x "$build/dem-report" ] && build_is_ours; then
    newer=$(find "$root/CMakeLists.txt" "$root/engine" "$root/render" "$root/reports" -type f \
      -newer "$build/dem-report" -print 2>/dev/null | head -n 1)
    [ -n "$newer" ] || return 0
    say "build/ may not be written by $(id -un 2>/dev/null || id -u), and its program is older than $newer;"
  else
    say "build/ may not be written by $(id -un 2>/dev/null || id -u), and holds no program for this folder;"
  fi
  say "let its owner run $root/dem-report once, or take a clone of your own"
  exit 3
}

# check_libraries PROGRAM: a library that was removed after the build is named
check_libraries() {
  "$1" version >/dev/null 2>&1 && return 0
  lost=$(ldd "$1" 2>/dev/null | awk '/not found/ { print $1 }' | sort -u | tr '\n' ' ')
  [ -z "$lost" ] || {
    say "the program cannot start: these libraries are missing: $lost"
    say "install their packages again, or remove $build and start again"
    exit 3
  }
}

prepare_build_folder() {
  take_turn
  if ! build_is_ours; then
    say "build/ belongs to another folder: made anew"
    rm -rf "$build" || exit 3
  fi
  mkdir -p "$build" || exit 3
}
