#!/usr/bin/env bash
# Makes figures of the paper and prints the numbers that docs/paper.md quotes: docs/paper/reproduce.sh [FIGURE]...
# Sweeps go to sweeps/, where what is done is not done again.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

riesel=${RIESEL:-build/release/app/riesel}

usage() {
  cat <<END
Usage: docs/paper/reproduce.sh FIGURE...

  fig3         single wall grain: stiffness, time step, contact law (seconds)
  fig4_5       row of wall grains (a minute)
  fig6_short   tube, one seed, 3 s (a quarter to half an hour on two cores)

The program is \$RIESEL, or else $riesel (./setup.sh build).
END
}

sweep() {
  "$riesel" sweep "scenarios/paper/$1.yaml"
}

# The table of a long campaign is kept; curves of impacts are quick to make again.
reproduce() {
  case $1 in
    fig3) for name in fig3 fig3_time_step fig3_laws; do sweep "$name"; done ;;
    fig4_5) sweep fig4_5 ;;
    fig6_short)
      sweep fig6_short
      cp sweeps/fig6_short/sweep.csv docs/paper/fig6_short.csv
      ;;
    *)
      usage >&2
      exit 2
      ;;
  esac
  /usr/bin/python3 -B docs/paper/figures.py "$1"
}

if (($# == 0)); then
  usage >&2
  exit 2
fi
for figure in "$@"; do reproduce "$figure"; done
