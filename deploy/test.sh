#!/usr/bin/env bash
# Builds and runs the tests. --deep adds the sanitizer builds and a short run of every fuzz target.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source deploy/phases.sh

deep=no
for argument in "$@"; do
  case "$argument" in
    --deep) deep=yes ;;
    *)
      echo "lifeline test: unknown option '$argument'; the only one is --deep" >&2
      exit 2
      ;;
  esac
done

jobs=1
fuzz_seconds=20
# Minutes under a sanitizer, and other numbers through code that other tests run there as well.
# And two bent maps so close to a limit that clang's numbers judge them otherwise than g++'s.
repetitions='MapsBentAgainstEachOther.*/50[13]|BentMapTest.*InBuilding[23]|IsMatchedNoMoreThanOnceASecond.*of20cm|NoneOf300IsMerged|Seeds.*/[0-9][0-9]+'

build() {  # PRESET [TARGET...]
  local preset="$1"
  shift
  cmake --preset "$preset" --log-level=WARNING &&
    cmake --build --preset "$preset" -j "$(parallel_jobs 1)" ${1:+--target "$@"}
}

run_tests() {  # PRESET JOBS [CTEST OPTIONS...]
  local preset="$1" at_once="$2"
  shift 2
  ctest --preset "$preset" -j "$at_once" --no-tests=error "$@" | tee "build/$preset-tests.log"
  return "${PIPESTATUS[0]}"
}

# One fuzz target for a while, on what it found in earlier runs (build/fuzz/corpus/).
run_fuzzer() {  # NAME
  local name="$1"
  local seeds="tests/fuzz/${name%_fuzz}/seeds" log="build/fuzz/$name.log"
  [[ -d "$seeds" ]] || seeds=""
  mkdir -p "build/fuzz/corpus/$name" "build/fuzz/failures"
  if ! "build/asan-ubsan/bin/$name" -max_total_time="$fuzz_seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/failures/$name-" "build/fuzz/corpus/$name" ${seeds:+"$seeds"} >"$log" 2>&1; then
    tail -n 40 "$log"
    echo "$name: failed; its input is in build/fuzz/failures/"
    return 1
  fi
  printf '%s: %s runs in %d s, nothing found\n' "$name" \
    "$(awk '/stat::number_of_executed_units/ {print $2}' "$log")" "$fuzz_seconds"
}

run_fuzzers() {
  local names
  names="$(find build/asan-ubsan/bin -name '*_fuzz' -printf '%f\n' | sort)"
  [[ -n "$names" ]] || { echo "no fuzz target was built"; return 1; }
  export -f run_fuzzer
  export fuzz_seconds
  xargs -P "$jobs" -I NAME bash -euo pipefail -c 'run_fuzzer NAME' <<<"$names"
}

phase "packages" deploy/setup.sh
jobs="$(parallel_jobs)"
phase "build (dev)" build dev
phase "tests (dev)" run_tests dev "$((2 * jobs + 1))"  # real processes mostly wait
if [[ "$deep" == yes ]]; then
  phase "build (address and undefined behaviour sanitizers, fuzz targets)" build asan-ubsan lifeline_inner_tests lifeline_fuzzers
  phase "tests (address and undefined behaviour sanitizers)" run_tests asan-ubsan "$((jobs + 1))" -LE 'system|bench|planted' -E "$repetitions|_NOT_BUILT"
  phase "build (thread sanitizer)" build tsan lifeline_thread_tests
  phase "tests (thread sanitizer)" run_tests tsan "$jobs" -L threads
  phase "fuzz targets" run_fuzzers
fi

print_phases
grep -h 'tests passed' build/dev-tests.log
