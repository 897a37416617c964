#!/usr/bin/env bash
# Installs the Debian packages given in a fresh, minimal Debian 12 and tries them there: the command runs,
# resumes and reports, Python reads, a program is built against the libraries, and removal leaves nothing.
#   tests/package/clean_debian.sh build/release/*.deb
# Needs root, debootstrap and the network; MIRROR names a mirror, ROOT a directory to keep.
set -euo pipefail

if (($# == 0)) || [[ "$1" == --help ]]; then
  sed -n 's/^# \{0,1\}//; 2,5p' "$0"
  exit 2
fi
if ((EUID != 0)); then
  echo "clean_debian.sh: debootstrap and chroot need root" >&2
  exit 2
fi

if [[ -n "${ROOT:-}" ]]; then
  root=$ROOT
else
  root=$(mktemp -d /tmp/clean-debian.XXXXXX)
  trap 'rm -rf "$root"' EXIT
fi

say() { printf '\n== %s\n' "$*"; }
inside() { chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }

if [[ ! -e "$root/etc/debian_version" ]]; then
  say "debootstrap"
  debootstrap --variant=minbase bookworm "$root" ${MIRROR:+"$MIRROR"} >"$root.log" || { tail "$root.log"; exit 1; }
  rm -f "$root.log"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir -p "$root/packages"
cp "$@" "$root/packages/"

say "install"
inside apt-get update -q
inside sh -c 'apt-get install -q -y --no-install-recommends /packages/*.deb'
inside sh -c 'dpkg --verify riesel libriesel-dev python3-riesel'

say "run, resume, report, read"
inside riesel --version
inside bash -ec '
  cd /root
  riesel run /usr/share/riesel/scenarios/periodic_tube.yaml --set tube.length="20 mm" \
    --set run.duration="10 ms" --out run
  riesel resume run --set run.duration="20 ms"
  riesel report run
  python3 -c "
import riesel
run = riesel.Run(\"run\")
print(run.estimate(\"mean_axial_velocity\"), run.provenance[\"riesel_version\"])"'

say "build against the libraries"
inside apt-get install -q -y --no-install-recommends make
inside bash -ec '
  cd /root
  cmake -S /usr/share/doc/libriesel-dev/examples/own_law_and_scenario -B cooling >/dev/null
  cmake --build cooling >/dev/null
  cooling/cooling run /usr/share/doc/libriesel-dev/examples/own_law_and_scenario/cooling.yaml \
    --set run.duration="5 ms" --out gas'

say "remove"
inside apt-get purge -q -y riesel libriesel-dev python3-riesel >/dev/null
left=$(inside find / -xdev -path /proc -prune -o -path /root -prune -o -path /packages -prune \
  -o -iname '*riesel*' -print)
if [[ -n "$left" ]]; then
  echo "left behind: $left" >&2
  exit 1
fi
say "all is well"
