#!/usr/bin/env bash
# fuzz.sh <target> [seconds]: looks for inputs that break a target (expression, options, msh), with clang's libFuzzer and
# sanitizers; begins with corpus/ and the files of the repository, keeps what it learns under build/fuzz/<target>.
set -eu
cd "$(dirname "$0")/../.."
target=$1 seconds=${2:-600} folder=build/fuzz
clang=$(command -v clang || command -v clang-14) || {
  echo "fuzz.sh: clang with libFuzzer is needed (Debian: clang-14 libclang-rt-14-dev)" >&2
  exit 1
}
cmake -S . -B "$folder" -DCMAKE_C_COMPILER="$clang" -DCMAKE_BUILD_TYPE=Debug -DMORTISE_FUZZ=ON \
  -DMORTISE_SANITIZE=address,undefined >/dev/null
cmake --build "$folder" -j "$(nproc)" --target "libfuzzer_$target" >/dev/null
mkdir -p "$folder/$target" "$folder/found"
case $target in
  msh) cp -n $(find tests options -name '*.msh' -size -32k) "$folder/$target" ;;
  options)
    cp -n options/*.opts tests/*/*.opts "$folder/$target"
    grep -oP '^mistake\(\w+ .*ARGS \K.*(?=\)$)' tests/mistakes/mistakes.cmake | while read -r change; do # every known mistake
      { cat tests/mistakes/boxes.opts && echo "$change"; } >"$folder/$target/mistake_$(echo "$change" | md5sum | cut -c1-8)"
    done
    ;;
  expression) grep -ho '"[^"]*"' options/*.opts tests/*/*.opts | tr -d '"' | sort -u | split -l 1 - "$folder/$target/value_" ;;
esac
# Words that are put in: the options and, of expressions, all that muParser knows.
{
  grep -oE '"-[a-z<][^" ]*"' src/scene/optiontable.c | sed -E 's/<body>/block/; s/<pair>/pair/; s/<probe>/probe/; s/<side>/top/'
  sed -n '/known_names\[\]/,/;/p' src/base/expression.c | grep -oE '"[a-z0-9]+"'
} | sort -u >"$folder/words"
# Faults leave memory behind, as the program ends with them: -fork begins anew when it is used up.
ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 "$folder/tests/libfuzzer_$target" \
  -fork=1 -ignore_ooms=1 -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2000 -malloc_limit_mb=500 \
  -dict="$folder/words" -close_fd_mask=3 -artifact_prefix="$folder/found/$target-" \
  ${FUZZ_OPTIONS:-} "$folder/$target" "tests/fuzz/corpus/$target"
