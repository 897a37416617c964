#!/usr/bin/env bash
# From a fresh checkout to a first result, or to a tested one: ./setup.sh help
set -euo pipefail

cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"

# All that the program needs.
build_packages=(
  cmake ninja-build g++ git
  libeigen3-dev libhdf5-dev libyaml-cpp-dev libcli11-dev libfmt-dev nlohmann-json3-dev
  libudunits2-dev zlib1g-dev librandom123-dev)
# Besides, what those need who work on riesel: for the tests and the scripts of docs and bench; who reads
# what riesel writes; a shell that completes its command line; what runs the tasks of a sweep; what
# finds out on which libraries a Debian package depends.
test_packages=("${build_packages[@]}" catch2
  python3 python3-numpy python3-h5py python3-yaml python3-scipy python3-matplotlib
  python3-netcdf4 python3-jsonschema zsh parallel dpkg-dev file)
# clang-tidy reads the compiler's command lines: libomp-dev is Clang's <omp.h>.
lint_packages=(clang-format clang-tidy libomp-dev shellcheck doxygen mypy)
# Shows the pages of riesel report to the tests, which are skipped without it.
browser_packages=(chromium)
# Which lines the tests reach (docs/reliability.md).
coverage_packages=(gcovr)
# Show trajectories to the tests, which are skipped without them.
look_packages=(paraview python3-paraview ffmpeg)
# Other codes and libraries of vector types, to compare speeds with (docs/suite.md); nothing else
# needs them.
peer_packages=(lammps liggghts yade openmpi-bin libxsimd-dev libhwy-dev)

# A queue, in which tests can run sweeps (docs/cluster.md).
cluster_packages=(slurm-wlm munge)

rooms=(engine io scenarios app tests bench)
riesel=build/release/app/riesel
run_input=scenarios/periodic_tube.yaml
run_output=runs/setup

usage() {
  cat <<END
Usage: ./setup.sh COMMAND

  run        install what is missing, build, and run $run_input
             into $run_output; ends with the summary on the screen
  test       install what is missing, build with warnings as errors, run all tests;
             further arguments go to ctest, e.g. -R engine
  build      install what is missing and build the release: $riesel
  lint       check formatting, C++, Python, shell scripts and what is written about the API
             (clang-format, clang-tidy, mypy, shellcheck, Doxygen); with rooms, as in
             lint engine io, clang-tidy reads these only
  analyze    let the analyzer of Clang read the sources one by one: four minutes
  api        the headers and the manual as pages: build/api/html/index.html
  coverage   build for it, run the tests and tell which lines they do not reach: fails if a
             test does, or below 95 % of engine or of io; further arguments go to ctest
  format     let clang-format rewrite the C++ sources
  packages   install the Debian packages that are missing for all that test does
  peers      install LAMMPS, LIGGGHTS and YADE too, for bench/peers/run.py, xsimd and Highway,
             for bench/simd
  browser    install Chromium too: the pages of reports are tested in it
  look       install ParaView and ffmpeg too, and test that they show trajectories
  cluster    install Slurm and munge too: sweeps can be tested on them
  help       this text
END
}

say() { printf '\n== %s\n' "$*"; }

die() {
  printf 'setup.sh: %s\n' "$*" >&2
  exit 1
}

# no_more ARGUMENT...: of the command, which takes none.
no_more() {
  (($# == 0)) && return
  printf "setup.sh: '%s' takes no arguments, as %s\n" "$command" "$*" >&2
  exit 2
}

missing_packages() {
  local package
  for package in "$@"; do
    if [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]]; then
      echo "$package"
    fi
  done
}

# Needs neither the network nor sudo when nothing is missing.
install_packages() {
  if ! command -v apt-get >/dev/null; then
    say "Not a Debian system. riesel needs what Debian calls: $*"
    return
  fi
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  if ((${#missing[@]} == 0)); then return; fi
  say "Installing ${missing[*]}"
  if ((EUID != 0)); then
    command -v sudo >/dev/null || die "neither root nor sudo; have these installed: ${missing[*]}"
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -q || die "apt-get update failed; missing: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}" ||
    die "apt-get could not install ${missing[*]}"
}

# build PRESET [arguments of cmake --build...]
build() {
  local preset=$1
  shift
  say "Building build/$preset"
  cmake --preset "$preset" || die "cmake could not configure build/$preset"
  cmake --build --preset "$preset" "$@" || die "the build in build/$preset failed"
}

# What decides about a result: the program and its input.
fingerprint() { sha256sum "$riesel" "$run_input"; }

# Runs once per program and input: a result that is there is shown, an interrupted run is continued,
# and a directory that belongs to another program or input is left alone. Beside a directory lie its
# fingerprint and what the run printed at its end.
run_scenario() {
  local out=$run_output number=1
  while [[ -e "$out" && "$(cat "$out.sha256" 2>/dev/null)" != "$(fingerprint)" ]]; do
    number=$((number + 1))
    out=$run_output-$number
  done

  mkdir -p "$(dirname "$out")"
  if [[ ! -e "$out" ]]; then
    say "Running $run_input into $out"
    fingerprint >"$out.sha256"
    "$riesel" run "$run_input" --out "$out" >"$out.txt"
  elif [[ ! -e "$out/summary.json" ]]; then
    say "Continuing the interrupted run in $out"
    "$riesel" resume "$out" >"$out.txt" || die "could not continue; to start again: rm -r $out"
  elif grep -qF "$(state_hash "$out")" "$out.txt"; then
    say "Nothing to do: $out is the result of this program and this input"
  elif [[ ! -s "$out.txt" ]]; then
    say "$out is done, but what it printed at its end was lost: its result is in $out/summary.json"
    return
  else
    say "$out was resumed since: its result is in $out/summary.json ('$riesel report $out' draws it)"
    return
  fi
  say "Summary"
  cat "$out.txt"
  say "The program is $riesel; go on with docs/first_run.md:"
  echo "    export PATH=\$PWD/$(dirname "$riesel"):\$PATH"
}

# Of the result in a directory.
state_hash() { sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1/p' "$1/summary.json"; }

cpp_files() { find "${rooms[@]}" examples -name '*.[ch]pp' | sort; }
cpp_sources() { find "$@" -name '*.cpp' | sort; }

# lint_units ROOM...: what the compiler's command lines name in these rooms.
lint_units() {
  local rooms
  rooms=$(IFS='|'; echo "$*")
  sed -n 's/.*"file": "\(.*\)".*/\1/p' build/lint/compile_commands.json | sort -u |
    while read -r file; do echo "${file#"$PWD"/}"; done | grep -E "^(build/lint/)?($rooms)/"
}

# As many processes as there are processors, each with the next file.
tidy() { xargs -n 1 -P "$(nproc)" clang-tidy --quiet "$@"; }

api() {
  mkdir -p build
  doxygen docs/Doxyfile
}

# Looks at the main file only, or takes the longer the more a unit holds: left to analyze.
main_file_checks='-*,clang-analyzer-core.*,clang-analyzer-cplusplus.*,misc-unused-*-decls,performance-unnecessary-value-param'

# lint ROOM...: all checks, even if the first one complains; clang-tidy reads these rooms.
lint() {
  local complaints=()
  say "clang-format"
  cpp_files | xargs clang-format --dry-run -Werror || complaints+=("clang-format (try ./setup.sh format)")
  say "shellcheck"
  shellcheck setup.sh .ci/run docs/paper/reproduce.sh tests/fuzz/seeds.sh tests/package/clean_debian.sh ||
    complaints+=(shellcheck)
  say "doxygen"
  api || complaints+=(doxygen)
  say "mypy"
  (cd python && mypy riesel) || complaints+=(mypy)
  # What takes the time are the headers of libraries, so units of several sources are read. A
  # "redefinition" across two sources of a room wants another name, or SKIP_UNITY_BUILD_INCLUSION as
  # in the room's CMakeLists.txt.
  build lint --target riesel_build_info
  say "clang-tidy"
  lint_units "$@" |
    tidy -p build/lint --checks='-clang-analyzer-*,-performance-unnecessary-value-param' ||
    complaints+=(clang-tidy)
  ((${#complaints[@]} == 0)) || die "complaints from: ${complaints[*]}"
}

# The tests of reliability do not count: they kill, and count the calls that write. Nor do those of how the
# program was compiled: here it is compiled for counting. The report comes even if a test fails. The rooms on
# which all results rest have to be reached each for itself.
coverage() {
  local complaints=() lines=build/coverage/lines.json room
  build coverage
  find build/coverage -name '*.gcda' -delete
  # Left by a test that calls the compiler itself.
  find build/coverage -maxdepth 1 -name '*.gcno' -delete
  ctest --preset coverage --label-exclude reliability \
    --exclude-regex 'test_vectorised|package_find_package' --parallel "$(nproc)" "$@" ||
    complaints+=("failed tests (named by ctest above)")
  gcovr --root . --object-directory build/coverage --filter 'engine/' --filter 'io/' \
    --filter 'scenarios/' --filter 'app/' --exclude '.*/include-rooms/' --print-summary \
    --txt - --json "$lines"
  for room in engine io; do
    say "Coverage of $room"
    gcovr --root . --add-tracefile "$lines" --filter "$room/" --print-summary --fail-under-line 95 \
      --txt /dev/null || complaints+=("less than 95 % of the lines of $room")
  done
  ((${#complaints[@]} == 0)) || die "$(IFS=,; echo "${complaints[*]}")"
}

# Not a part of lint, since it takes minutes.
analyze() {
  build dev --target riesel_build_info
  cpp_sources engine io scenarios app | tidy -p build/dev --checks="$main_file_checks"
}

command=${1:-help}
shift || true
case $command in
  run | build | analyze | api | format | packages | browser | look | cluster | peers) no_more "$@" ;;
esac
case $command in
  run)
    install_packages "${build_packages[@]}"
    build release --target riesel
    run_scenario
    ;;
  test)
    install_packages "${test_packages[@]}"
    build ci
    sync # what has been built: tests with limits on the clock would wait for it
    say "Testing"
    ctest --preset ci --parallel "$(nproc)" "$@"
    ;;
  build)
    install_packages "${build_packages[@]}"
    build release
    ;;
  lint)
    install_packages "${test_packages[@]}" "${lint_packages[@]}"
    if (($# == 0)); then set -- "${rooms[@]}"; fi
    lint "$@"
    ;;
  analyze)
    install_packages "${test_packages[@]}" "${lint_packages[@]}"
    analyze
    ;;
  api)
    install_packages "${lint_packages[@]}"
    api
    say "See build/api/html/index.html"
    ;;
  coverage)
    install_packages "${test_packages[@]}" "${coverage_packages[@]}"
    coverage "$@"
    ;;
  format)
    install_packages "${lint_packages[@]}"
    cpp_files | xargs clang-format -i
    ;;
  packages) install_packages "${test_packages[@]}" ;;
  browser) install_packages "${test_packages[@]}" "${browser_packages[@]}" ;;
  look)
    install_packages "${test_packages[@]}" "${look_packages[@]}"
    build ci --target riesel
    ctest --preset ci -R 'cli/test_(trajectory|paraview|film)'
    ;;
  cluster) install_packages "${test_packages[@]}" "${cluster_packages[@]}" ;;
  peers) install_packages "${test_packages[@]}" "${peer_packages[@]}" ;;
  help | -h | --help) usage ;;
  *)
    usage >&2
    exit 2
    ;;
esac
