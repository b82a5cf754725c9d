#!/usr/bin/env bash
# Builds the page outside of the source tree: build.sh SOURCE WORK PROTO OUT_CPP.
# The packages are those of package-lock.json; where npm cannot be reached, those of an earlier build or of npm's cache.
set -euo pipefail
source="$1" work="$2" proto="$3" out="$4"
log="$work/build.log"
mkdir -p "$work"

stop() {
  tail -n 25 "$log" >&2 || true
  printf 'dashboard page: %s\n' "$*" >&2
  exit 1
}

cp -R "$source"/{index.html,package.json,package-lock.json,tsconfig.json,vite.config.ts,embed.mjs} "$work/"
rm -rf "$work/src" "$work/public"
cp -R "$source/src" "$work/src"
[[ ! -d "$source/public" ]] || cp -R "$source/public" "$work/public"
cd "$work"

# From the cache first: needs no network once it was there.
lock="$(sha256sum package-lock.json)"
if [[ "$(cat node_modules/.lifeline-lock 2>/dev/null || true)" != "$lock" ]]; then
  npm ci --ignore-scripts --no-audit --no-fund --prefer-offline >"$log" 2>&1 ||
    stop "npm ci failed: the packages of coordinator/dashboard/page/package-lock.json are needed once, from npm's registry" \
      "or its cache; is the network up?"
  printf '%s' "$lock" >node_modules/.lifeline-lock
fi

cp "$proto" src/dashboard.proto
protoc -I src --plugin=node_modules/.bin/protoc-gen-es --es_out=src --es_opt=target=ts dashboard.proto >"$log" 2>&1 ||
  stop "idl/dashboard.proto does not compile"
node_modules/.bin/tsc --noEmit >"$log" 2>&1 || stop "the TypeScript has errors"
node_modules/.bin/vite build --logLevel error >"$log" 2>&1 || stop "vite failed"
node embed.mjs dist "$out"
