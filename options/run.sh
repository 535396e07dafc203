#!/usr/bin/env bash
# run.sh -- from a fresh clone to a picture:  bash options/run.sh [-n <ranks>] <scene> [-any_option value ...]
set -eu
cd "$(dirname "$0")/.."
. tests/packages.sh

ranks=1
if [ "${1:-}" = -n ]; then
  ranks=${2:-}
  [[ "$ranks" =~ ^[1-9][0-9]*$ ]] || die "-n needs a number of ranks"
  shift 2
fi
scene=${1:-}
scene=${scene##*/}
scene=${scene%.opts}
[ -n "$scene" ] && [ -f "options/$scene.opts" ] ||
  die "${scene:+there is no scene '$scene'; }the scenes are $(cd options && ls *.opts | sed 's/\.opts$//' | paste -s -d ' ' -)"
shift

install_missing $build_packages $python_packages
set_up_mpi
[ -f build/CMakeCache.txt ] || echo "building in build/"
[ -f build/Makefile ] || quietly cmake -S . -B build
quietly cmake --build build --target mortise -j "$(nproc)"

launcher=()
[ "$ranks" -gt 1 ] && launcher=(env OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 mpiexec -n "$ranks")
verdict=0
"${launcher[@]}" build/mortise -options_file "options/$scene.opts" -output "results/$scene" "$@" || verdict=$?
[ "$verdict" -eq 0 ] || [ "$verdict" -eq 2 ] || exit "$verdict" # 2: there is no solution, and a picture of why
grep -q '"dimension":[[:space:]]*3' "results/$scene.json" && set_up_pictures
/usr/bin/python3 src/plot/mortise-plot "results/$scene"
echo "fields:  results/$scene.xdmf (ParaView), results/$scene.h5"
exit "$verdict"
