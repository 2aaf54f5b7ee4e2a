#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes stand-ins for the figures of the paper; docs/paper.md shows them beside what the paper reports.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tools/reproduce_paper.sh [--output DIR] [--only NAME,...] [--peers] [--list]
Makes stand-ins for Figures 4-9, 13-15, 18-21 and Table 1 of the paper from generated models and the shipped scan.
  --output DIR     where clouds, pictures, bars and tables go (default build/paper)
  --only NAME,...  only these, names as --list prints them
  --peers          also build and run CGAL's WLOP and bilateral smoothing (needs libcgal-dev; stays on in build/release)
  --list           print the names and what each shows
Builds pcl_gpf_tool and the benchmarks it needs in build/release; install what that takes with tools/install_dependencies.sh.
On two cores: about 5 minutes once built, with --peers about 10. Repeatable: every random number has a seed.
TEXT
}

list() {
  cat <<'TEXT'
figure4   outlier weights omega on a plane with outliers, seen from the side
figure5   repulsion weights mu on a cube
figure6   numbers of samples M on a block, and each upsampled to as many points
figure7   cube, 3 % noise: methods
figure8   block, 1.5 % noise: methods, points and surfaces
figure9   star, 1 % noise: methods, points and surfaces
figure13  accuracy on a scanned sphere
figure14  accuracy on a scanned relief
figure15  mean squared errors of Figures 13 and 14
figure18  strong outliers: a plane and a cube
figure19  heavy noise: block, 3 %
figure20  open boundaries: a cap, and the shipped scan
figure21  gap filling beside edges
table1    seconds at the sizes of the paper's table
TEXT
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$root/build/paper
only=
configure=(-Wno-dev)
while [[ $# -gt 0 ]]; do
  case "$1" in
    --output) out=${2:?--output needs a folder}; shift ;;
    --only) only=${2:?--only needs names}; shift ;;
    --peers) configure+=(-DPCL_GPF_BENCHMARK_PEERS=ON) ;;
    --list) list; exit 0 ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
names=$(list | cut -d ' ' -f 1)
for name in ${only//,/ }; do
  grep -qx "$name" <<<"$names" || { echo "there is no \"$name\"; there are" "${names//$'\n'/ }" >&2; exit 2; }
done
[[ $out == /* ]] || out=$PWD/$out
mkdir -p "$out"

cd "$root"
cmake --preset release "${configure[@]}"
cmake --build build/release --target pcl_gpf_tool quality bars
tool() { "$root/build/release/tools/pcl_gpf_tool" "$@" --overwrite --quiet; }
quality=$root/build/release/tests/benchmarks/quality/quality
bars=$root/build/release/tests/benchmarks/quality/bars

# Methods as `quality` names them, and what they are called in pictures.
methods=(rimls-best)
labels=(RIMLS)
if grep -qx 'PCL_GPF_BENCHMARK_PEERS:BOOL=ON' build/release/CMakeCache.txt; then
  methods+=(wlop-best bilateral-best)
  labels+=(WLOP bilateral)
else
  echo "Built without CGAL: WLOP and bilateral smoothing are left out (--peers brings them in)."
fi
methods+=(paper ours)
labels+=(literal ours)

join() { local IFS=,; echo "$*"; }

# Runs `quality` for one cloud: measure DIR MODEL KIND NOISE SIZE METHODS [OPTION...]. Leaves DIR/records.csv and a cloud for each
# method with the name of the method, all others than letters, digits, - and . replaced by _.
measure() {
  local dir=$out/$1 model=$2 kind=$3 noise=$4 size=$5 wanted=$6 file
  shift 6
  rm -rf "$dir"
  "$quality" --models "$model" --kinds "$kind" --noises "$noise" --sizes "$size" --methods "$wanted" \
    --csv "$dir.csv" --cloud-dir "$dir" "$@"
  mv "$dir.csv" "$dir/records.csv"
  for file in "$dir"/*.ply; do
    mv "$file" "$dir/$(basename "$file" | sed "s/^.*_${noise}_//")"
  done
}

# The clean surface as many points: truth DIR MODEL.
truth() {
  "$quality" --models "$2" --noises 0 --sizes 100000 --methods input --cloud-dir "$out/$1/truth" >/dev/null
  mv "$out/$1"/truth/*.ply "$out/$1/truth.ply"
  rmdir "$out/$1/truth"
}

# A column of the record of a method: column DIR METHOD COLUMN.
column() {
  awk -F , -v method="$2" -v wanted="$3" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i == wanted) at = i }
    $7 == method { print $at }' "$out/$1/records.csv"
}

# A number of a JSON report: number KEY <REPORT.
number() { sed -n "s/^  \"$1\": \([-+.e0-9]*\),*\$/\1/p"; }

safe() { echo "${1//[^A-Za-z0-9.-]/_}"; }

# EAR upsampling to a common count, and RIMLS surfaces of that: upsample DIR COUNT METHOD..., mesh DIR METHOD...
upsample() {
  local dir=$out/$1 count=$2 method
  shift 2
  for method; do
    method=$(safe "$method")
    tool upsample "$dir/$method.ply" -o "$dir/$method-dense.ply" --count "$count"
  done
}
mesh() {
  local dir=$out/$1 method
  shift
  for method; do
    method=$(safe "$method")
    tool mesh "$dir/$method-dense.ply" -o "$dir/$method-mesh.ply" --resolution 150
  done
}

# draw PICTURE LABELS FILE... -- OPTION...: a panel for each file.
draw() {
  local picture=$out/$1 titles=$2 files=()
  shift 2
  while [[ $# -gt 0 && $1 != -- ]]; do files+=("$1"); shift; done
  shift
  tool render "${files[@]}" -o "$picture" --labels "$titles" --width 230 --height 200 --zoom 1.15 "$@"
}

# LABEL=VALUE of a column for every method, times a factor: values DIR COLUMN FACTOR.
values() {
  local i
  for i in "${!methods[@]}"; do
    echo "${labels[i]}=$(awk -v v="$(column "$1" "${methods[i]}" "$2")" -v f="$3" 'BEGIN { print v * f }')"
  done
}

# The paper's error, from points of the true surface to the nearest point of the dense cloud: a LABEL=VALUE for each method and for
# the clean cloud. accuracy DIR mean|square; the mean in 1e-4 of the diagonal, the square in 1e-6 of its square.
accuracy() {
  local dir=$out/$1 what=$2 diagonal i file
  diagonal=$(tool info "$dir/truth.ply" --json | number diagonal)
  for i in "${!methods[@]}" clean; do
    if [[ $i == clean ]]; then file=$dir/clean; else file=$dir/${methods[i]}; fi
    tool compare "$dir/truth.ply" "$file-dense.ply" --json >"$file-accuracy.json"
    awk -v label="$(if [[ $i == clean ]]; then echo clean; else echo "${labels[i]}"; fi)" -v d="$diagonal" -v what="$what" \
      -v mean="$(number mean <"$file-accuracy.json")" -v rms="$(number rms <"$file-accuracy.json")" \
      'BEGIN { print label "=" (what == "mean" ? 1e4 * mean / d : 1e6 * rms * rms / d / d) }'
  done
}

# A comparison of all methods, with pictures of the points and, if wanted, of the surfaces:
# compare_methods NAME TITLE MODEL KIND NOISE SIZE COUNT points|surfaces [RENDER OPTION...]
compare_methods() {
  local name=$1 title=$2 model=$3 kind=$4 noise=$5 size=$6 count=$7 what=$8 points=() meshes=() method titles mean ecov
  shift 8
  measure "$name" "$model" "$kind" "$noise" "$size" "$(join input "${methods[@]}")"
  upsample "$name" "$count" "${methods[@]}"
  for method in "${methods[@]}"; do
    points+=("$out/$name/$method-dense.ply")
    meshes+=("$out/$name/$method-mesh.ply")
  done
  titles=$(join "${labels[@]}")
  draw "$name.png" "input,$titles" "$out/$name/input.ply" "${points[@]}" -- "$@"
  if [[ $what == surfaces ]]; then
    mesh "$name" "${methods[@]}"
    draw "$name-surfaces.png" "$titles" "${meshes[@]}" -- "$@"
  fi
  mapfile -t mean < <(values "$name" mean 1)
  mapfile -t ecov < <(values "$name" ecov 1)
  "$bars" "$out/$name.svg" "$title" --panel "mean error, 1e-4 diagonal" "input=$(column "$name" input mean)" "${mean[@]}" \
    --panel "edges to nearest point (ecov)" "input=$(column "$name" input ecov)" "${ecov[@]}"
}

figure7() { compare_methods figure7 "Cube, 3 % uniform noise" cube uniform 3 33490 60000 points; }
figure8() { compare_methods figure8 "Block, 1.5 % uniform noise" block uniform 1.5 33490 60000 surfaces; }
figure9() { compare_methods figure9 "Star, 1 % uniform noise" star uniform 1 75053 100000 surfaces; }

for name in $names; do
  [[ -z $only || ,$only, == *,$name,* ]] || continue
  declare -F "$name" >/dev/null || continue
  echo "== $name"
  "$name"
done
