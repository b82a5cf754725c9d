#!/usr/bin/env bash
# The packages of package-lock.json into a folder: fetch_packages.sh SOURCE FOLDER.
set -euo pipefail
source="$1" folder="$2"
mkdir -p "$folder"
cp "$source"/package.json "$source"/package-lock.json "$folder/"
cd "$folder"
if ! npm ci --ignore-scripts --no-audit --no-fund --prefer-offline >npm.log 2>&1; then
  tail -n 15 npm.log >&2
  echo "browser tests: npm ci failed: the packages of tests/support/browser/package-lock.json are needed once, from npm's registry or its cache; is the network up?" >&2
  exit 1
fi
touch packages.stamp
