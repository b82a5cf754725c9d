#!/usr/bin/env bash
# Builds the release programs and links them into build/bin/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source deploy/phases.sh
if (($#)); then
  echo "lifeline build: takes no arguments, got '$1'" >&2
  exit 2
fi

deploy/setup.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release -j "$(parallel_jobs)"
mkdir -p build/bin
for program in build/release/bin/lifeline-*; do
  ln -sfn "../release/bin/${program##*/}" "build/bin/${program##*/}"
done
