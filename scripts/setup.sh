#!/usr/bin/env bash
# setup.sh [LIST...]: installs the Debian packages named in scripts/packages.txt (and in further lists) that are missing,
# and fetches the real volumes. Says what it does; does nothing, and needs no network, where all is there.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

sudo=""
if [ "$(id -u)" -ne 0 ]; then sudo="sudo"; fi

wanted=$(cat "$here/packages.txt" "$@" | sed 's/#.*//' | awk 'NF {print $1}')
missing=""
for package in $wanted; do
  if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != "installed" ]; then
    # Some names are provided by a package of another name (clang-format by clang-format-14).
    missing="$missing $package"
  fi
done
if [ -n "$missing" ]; then
  echo "setup: installing with apt:$missing"
  export DEBIAN_FRONTEND=noninteractive
  $sudo apt-get -qq update
  # shellcheck disable=SC2086
  $sudo apt-get -qq install -y --no-install-recommends $missing >/dev/null
else
  echo "setup: all packages are there"
fi

"$here/fetch_data.sh"
