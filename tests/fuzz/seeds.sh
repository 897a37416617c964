#!/bin/bash
# Makes those seeds of the corpus that riesel writes itself, by short runs of the settings in corpus/yaml:
#   tests/fuzz/seeds.sh build/ci/app/riesel
set -eu
riesel=$(realpath "$1")
cd "$(dirname "$0")/corpus"
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# result SETTINGS NAME [OPTION...]: the summary of a run becomes json/NAME.
result() {
  local settings=$1 name=$2
  shift 2
  "$riesel" run "yaml/$settings" --out "$scratch/$name" --threads 1 "$@" > "$scratch/screen.txt"
  cp "$scratch/$name/summary.json" "json/$name"
}

small=(--set run.duration='5 ms' --set tube.width='10 mm' --set tube.length='10 mm' --set grains.area_fraction=0.3)
result periodic_tube.yaml flow "${small[@]}"
result shaken_tube.yaml shaken_flow
result single_wall_grain.yaml curve --set impact.axial_velocity='[1, 5]'
result bead_column.yaml column
cp "$scratch/shaken_flow/effective.yaml" yaml/effective_tube.yaml

# Of two points the second fails: its contacts are so soft that grains go through the walls.
cat > "$scratch/sweep.yaml" << END
base: $PWD/yaml/periodic_tube.yaml
set: {run.duration: 5 ms, tube.width: 10 mm, tube.length: 10 mm, grains.area_fraction: 0.3}
axes: {contact.stiffness: [2000 N/m, 0.5 N/m]}
END
status=0
"$riesel" sweep "$scratch/sweep.yaml" --out "$scratch/sweep" --jobs 1 > "$scratch/screen.txt" 2>&1 || status=$?
((status == 1))
cp "$scratch/sweep/manifest.json" json/manifest
cp "$(grep -L '"failure": ""' "$scratch"/sweep/points/*/attempts.json)" json/attempts
