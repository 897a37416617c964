#!/usr/bin/env bash
# Makes figures of the paper and prints the numbers that docs/paper.md quotes: docs/paper/reproduce.sh [FIGURE]...
# Sweeps go to sweeps/, where what is done is not done again.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

riesel=${RIESEL:-build/release/app/riesel}
rigid=${RIGID:-build/bench/bench/rigid/rigid}

usage() {
  cat <<END
Usage: docs/paper/reproduce.sh FIGURE...

  fig3         single wall grain: stiffness, time step, contact law (seconds)
  fig4_5       row of wall grains (some seconds)
  fig6         tube, slow starts of three stiffnesses, ten seeds, and the next one (70 minutes on two cores)
  fig6_fast    tube, starts from below and above the fast states (an hour)
  fig6_steps   the same, and what time step and attraction make of the fast states (90 minutes)
  fig6_thresholds  end of the slow branch over spacing, width and length, ten seeds; hysteresis, lifetimes (an hour)
  fig6_map     tube, slow and fast starts over the spacing of the wall grains (ten minutes)
  fig6_short   tube of 100 mm, one seed, 3 s (five minutes)
  fig6_rigid   tube, rigid grains and stiffer ones (40 minutes; wants the program \$RIGID, or else $rigid)
  fig6_balance predicted states from single impacts (seconds; reads the tables and runs of fig6 and fig6_fast)

The program is \$RIESEL, or else $riesel (./setup.sh build).
END
}

sweep() {
  "$riesel" sweep "scenarios/paper/$1.yaml"
}

# The tables of long campaigns are kept; curves of impacts are quick to make again.
campaigns() {
  local name
  for name in "$@"; do
    sweep "$name"
    /usr/bin/python3 -B docs/paper/keep.py "sweeps/$name" "docs/paper/$name.csv"
  done
}

# Rigid grains from slow and fast starts; then what cutting off series of impacts without end makes of it.
rigid_flows() {
  local flows=("$rigid" flows scenarios/periodic_tube.yaml --set tube.length='48 mm' --set run.duration='12 s' --seeds 3)
  local e_n=0.60,0.65,0.70,0.74,0.76,0.78,0.80,0.85,0.87,0.88,0.89,0.90,0.95,0.96,0.97
  local made
  made=$(mktemp -d)
  "${flows[@]}" --start 1,100 --restitution "$e_n" --out "$made/flows.csv"
  "${flows[@]}" --start 1 --restitution 0.60,0.80 --shortest-interval 1e-6,1e-8 --out "$made/intervals.csv"
  { cat "$made/flows.csv" && tail -n +2 "$made/intervals.csv"; } >docs/paper/fig6_rigid.csv
  rm -r "$made"
}

reproduce() {
  case $1 in
    fig3) for name in fig3 fig3_time_step fig3_laws; do sweep "$name"; done ;;
    fig4_5) sweep fig4_5 ;;
    fig6_short)
      sweep fig6_short
      cp sweeps/fig6_short/sweep.csv docs/paper/fig6_short.csv
      ;;
    fig6) campaigns fig6_slow fig6_fast fig6_fast_long fig6_stiff ;;
    fig6_fast) campaigns fig6_fast fig6_fast_long fig6_stiff ;;
    fig6_steps) campaigns fig6_fast fig6_fast_long fig6_stiff
      campaigns fig6_checks fig6_clipped_fast fig6_locking ;;
    fig6_thresholds) campaigns fig6_slow fig6_spacing fig6_narrow fig6_length fig6_choices fig6_clipped
      campaigns fig6_hysteresis fig6_lifetimes ;;
    fig6_map) campaigns fig6_map ;;
    fig6_rigid)
      rigid_flows
      campaigns fig6_stiffer
      ;;
    fig6_balance)
      sweep fig6_curves
      /usr/bin/python3 -B docs/paper/keep_profiles.py
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
