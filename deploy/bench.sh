#!/usr/bin/env bash
# Runs a benchmark of tests/bench/ from the release build: bench NAME [--out FILE].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

names="$(find tests/bench -mindepth 1 -maxdepth 1 -type d -printf '%f ' 2>/dev/null || true)"
if [[ -z "$names" ]]; then
  echo "lifeline bench: this version has no benchmarks" >&2
  exit 2
fi
if [[ $# -eq 0 || " $names" != *" $1 "* ]]; then
  echo "lifeline bench: give the name of one of these: $names" >&2
  exit 2
fi
source deploy/phases.sh
deploy/build.sh
cmake --build --preset release -j "$(parallel_jobs)" --target lifeline-bench
ln -sfn ../release/bin/lifeline-bench build/bin/lifeline-bench
exec build/bin/lifeline-bench "$@"
