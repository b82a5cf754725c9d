#!/usr/bin/env bash
# Installs the packages of packages.txt that are missing, by apt, as root or through sudo.
# Nothing missing: says nothing, needs no network and no rights.
set -euo pipefail
list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

stop() {
  printf 'setup: %s\n' "$*" >&2
  exit 1
}

# Those packages of the list that are not installed, one a line. One that an installed package provides is there
# (another vendor's nodejs brings npm, and forbids Debian's).
missing_packages() {
  comm -23 <(sed 's/#.*//; s/[[:space:]]//g; /^$/d' "$list" | sort -u) \
    <(dpkg-query -W -f='${db:Status-Status} ${Package},${Provides}\n' | sed -n 's/^installed //p' | tr , '\n' |
      sed 's/(.*//; s/[[:space:]]//g; /^$/d' | sort -u)
}

# apt COMMAND...: no questions, waits for another apt to finish, keeps quiet unless it fails.
as_root=()
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -q -y \
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" >"$log" 2>&1
}

command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
  stop "this machine has no apt: install what deploy/packages.txt names (Debian 12 packages) by hand"
mapfile -t missing < <(missing_packages)
((${#missing[@]})) || exit 0

if ((EUID != 0)); then
  command -v sudo >/dev/null ||
    stop "neither root nor sudo: as root, run: apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo)
fi
log="$(mktemp)"
trap 'rm -f "$log"' EXIT

give_up() {
  local reason
  reason="$(grep -m 1 -E '^(E|Err|W):' "$log" || tail -n 1 "$log")"
  mapfile -t missing < <(missing_packages)
  stop "could not install ${missing[*]}; apt says: ${reason:-nothing}; is the network up?"
}

printf 'setup: these Debian packages are missing and will be installed by apt%s:\n  %s\n' \
  "${as_root:+ through sudo}" "${missing[*]}"
echo "setup: reading the package lists"
apt update || true # stale lists matter only if what follows fails
echo "setup: downloading (on a bare machine about 0.7 GB)"
apt install --no-install-recommends --download-only "${missing[@]}" || give_up
echo "setup: unpacking and configuring (minutes)"
apt install --no-install-recommends "${missing[@]}" || give_up
echo "setup: done"
