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
  fig6_map     tube, spacing of the wall grains, end of the slow branch (a quarter of an hour)
  fig6_fast    tube, starts near the fast branch (minutes)
  fig6_balance predicted states from single impacts (seconds; reads the tables of the two before)

The program is \$RIESEL, or else $riesel (./setup.sh build).
END
}

sweep() {
  "$riesel" sweep "scenarios/paper/$1.yaml"
}

# The tables of long campaigns are kept; curves of impacts are quick to make again.
campaign() {
  sweep "$1"
  /usr/bin/python3 -B docs/paper/keep.py "sweeps/$1" "docs/paper/$1.csv"
}

reproduce() {
  case $1 in
    fig3) for name in fig3 fig3_time_step fig3_laws; do sweep "$name"; done ;;
    fig4_5) sweep fig4_5 ;;
    fig6_short)
      sweep fig6_short
      cp sweeps/fig6_short/sweep.csv docs/paper/fig6_short.csv
      ;;
    fig6_map) for name in fig6_map fig6_end; do campaign "$name"; done ;;
    fig6_fast) campaign fig6_fast ;;
    fig6_balance) sweep fig6_curves ;;
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
