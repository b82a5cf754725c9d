#!/usr/bin/env bash
# Builds what is not built yet and runs the demo with the given options.
set -euo pipefail
root="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
"$root/deploy/build.sh"
exec "$root/build/bin/lifeline-demo" "$@"
