#!/usr/bin/env bash
# check.sh [long] -- everything that is asked of a change: warnings, sanitizers, valgrind, and last all other tests;
# long: all tests with sanitizers, and scenes on 1, 2 and 4 ranks at least.
set -eu
cd "$(dirname "$0")/.."
case "${1:-}" in
  "") long=OFF sanitized="-L sanitize" rest="-LE again" ;;
  long) long=ON sanitized="-LE house" rest="" ;;
  *) echo "usage: check.sh [long]" >&2 && exit 2 ;;
esac
. tests/packages.sh
. tests/libraries.sh
install_missing $build_packages
if [ $long = ON ]; then install_missing $pip_packages; fi
install_missing $python_packages & # what only the tests need, while the program is built
installing=$!
set_up_mpi
jobs=$(env -u OMP_NUM_THREADS nproc) # which otherwise tells the number of threads that a user wants of OpenMP
tests=$((5 * jobs)) # side by side: one that runs on several ranks counts as many, and its ranks wait for each other, and for mpiexec to start them

# What makes building faster, where it is there: every unit test is linked with the objects of its layers.
faster="" linker=""
if command -v ccache >/dev/null; then
  faster="-DCMAKE_C_COMPILER_LAUNCHER=ccache"
  export CCACHE_SLOPPINESS=pch_defines,time_macros # without these it keeps nothing that is compiled with a precompiled header
fi
if command -v ld.gold >/dev/null; then linker="-fuse-ld=gold"; fi

# build <folder> <cmake option> ...
build() {
  local folder=$1
  shift
  echo "building $folder"
  quietly cmake -S . -B "$folder" -DMORTISE_WERROR=ON $faster -DCMAKE_EXE_LINKER_FLAGS="$linker $starting" ${starting:+-DMORTISE_ORDER_LIBRARIES=OFF} "$@"
  quietly cmake --build "$folder" -j "$jobs"
}

# check_sanitized <folder> <options of ctest> <tests side by side>
check_sanitized() {
  echo "testing with sanitizers"
  quietly ctest --test-dir "$1" $2 -j "$3" --output-on-failure
}

# The memory of the few unit tests whose arrays are indexed most, and of objects that end one after the other, within PETSc, too, where
# sanitizers do not look; suppressed is what Open MPI does at its start and end.
check_memory() {
  local valgrind="valgrind --quiet --error-exitcode=9 --suppressions=/usr/share/openmpi/openmpi-valgrind.supp" module unit="$1/tests/test_units "
  if [ $long = ON ]; then unit="$1/tests/test_"; fi
  for module in clip dual element boxtree; do
    echo "valgrind: $module"
    quietly $valgrind $unit$module -skip_petscrc
  done
  echo "valgrind: multigrid"
  quietly $valgrind "$1/mortise" -skip_petscrc -options_file options/two_plates.opts -upper_dm_plex_box_faces 2,2 -lower_dm_plex_box_faces 1,1 \
    -dm_refine 1 -pc_type truncatedmg -quiet
  echo "valgrind: the public interface"
  quietly $valgrind "$1/tests/api_calls" options -skip_petscrc
}

# What a BLAS computes differs in the last places from one processor to another: tests that compare two runs, with the kernels of each.
check_kernels() {
  local kernels="" kind own
  own=$(OPENBLAS_VERBOSE=2 "$1/mortise" -version 2>&1 | sed -n 's/^Core: *//p')
  case $own in # those of this processor are tested with all the rest; these kinds share theirs
    Zen) own=Haswell ;;
    Cooperlake | SapphireRapids) own=SkylakeX ;;
  esac
  if grep -qw avx2 /proc/cpuinfo && [ "$own" != Haswell ]; then kernels=Haswell; fi
  if grep -qw avx512vl /proc/cpuinfo && [ "$own" != SkylakeX ]; then kernels="$kernels SkylakeX"; fi
  for kind in $kernels; do
    echo "testing with OpenBLAS's kernels of $kind"
    OPENBLAS_CORETYPE=$kind quietly ctest --test-dir "$1" -R '^(unwritten|study\.two_plates)\.' -j "$tests" --output-on-failure
  done
}

starting=$(starting_flags "$PWD/build/unused")
# In the long run, each file reads its headers itself: one that lacks an include does not compile.
build build/check -DCMAKE_BUILD_TYPE=Release -DMORTISE_TEST_LONG=$long -DCMAKE_DISABLE_PRECOMPILE_HEADERS=$long
build build/sanitize -DCMAKE_BUILD_TYPE=Debug -DMORTISE_SANITIZE=address,undefined
wait $installing
sanitizing=""
if [ $long = ON ]; then
  check_sanitized build/sanitize "$sanitized" "$tests"
else # beside all others: neither waits for the last test of the other
  check_sanitized build/sanitize "$sanitized" $((2 * jobs)) &
  sanitizing=$!
  trap 'kill $sanitizing 2>/dev/null || true' EXIT
fi
if [ -z "${CI:-}" ] && command -v valgrind >/dev/null; then check_memory build/check; fi
check_kernels build/check
failed=0
ctest --test-dir build/check $rest -j "$tests" --output-on-failure || failed=1
[ -z "$sanitizing" ] || wait $sanitizing || failed=1
exit $failed
