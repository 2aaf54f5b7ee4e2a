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
Builds pcl_gpf_tool and two benchmarks in build/release; tools/install_dependencies.sh installs what that takes.
On two cores: about 5 minutes once built, with --peers about 15. Repeatable: every random number has a seed.
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
peers=no
if grep -qx 'PCL_GPF_BENCHMARK_PEERS:BOOL=ON' build/release/CMakeCache.txt; then
  peers=yes
  methods+=(wlop-best bilateral-best)
  labels+=(WLOP bilateral)
else
  echo "Built without CGAL: WLOP and bilateral smoothing are left out (--peers brings them in)."
fi
methods+=(paper ours)
labels+=(literal ours)

join() { local IFS=,; echo "$*"; }

# Runs `quality` for one cloud: measure DIR MODEL KIND NOISE SIZE METHODS [OPTION...]. Leaves DIR/records.csv and a
# cloud for each method under its name, with _ for all but letters, digits, - and point.
measure() {
  local dir=$out/$1 model=$2 kind=$3 noise=$4 size=$5 wanted=$6 file
  shift 6
  rm -rf "$dir"
  "$quality" --models "$model" --kinds "$kind" --noises "$noise" --sizes "$size" --methods "$wanted" \
    --csv "$dir.csv" --cloud-dir "$dir" "$@"
  mv "$dir.csv" "$dir/records.csv"
  for file in "$dir"/*.ply; do
    mv "$file" "$dir/${file#*_"${noise}"_}"
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

# draw PICTURE LABELS FILE... -- OPTION...: a panel for each file, `height` pixels high.
height=200
draw() {
  local picture=$out/$1 titles=$2 files=()
  shift 2
  while [[ $# -gt 0 && $1 != -- ]]; do files+=("$1"); shift; done
  shift
  tool render "${files[@]}" -o "$picture" --labels "$titles" --width 230 --height "$height" "$@"
}

# The paper's error, from points of the true surface to the nearest point of the dense cloud: LABEL=VALUE for each
# method, and for the clean cloud where there is one.
# accuracy DIR mean|square; 1e-4 of the diagonal, 1e-6 of its square.
accuracy() {
  local dir=$out/$1 what=$2 diagonal i file
  local all=("${methods[@]}") titles=("${labels[@]}")
  [[ ! -e $dir/clean-dense.ply ]] || { all+=(clean); titles+=(clean); }
  diagonal=$(tool info "$dir/truth.ply" --json | number diagonal)
  for i in "${!all[@]}"; do
    file=$dir/$(safe "${all[i]}")
    tool compare "$dir/truth.ply" "$file-dense.ply" --json >"$file-accuracy.json"
    awk -v label="${titles[i]}" -v d="$diagonal" -v what="$what" \
      -v mean="$(number mean <"$file-accuracy.json")" -v rms="$(number rms <"$file-accuracy.json")" \
      'BEGIN { print label "=" (what == "mean" ? 1e4 * mean / d : 1e6 * rms * rms / d / d) }'
  done
}

# A column of several methods: sweep DIR COLUMN LABELS METHOD... prints LABEL=VALUE.
sweep() {
  local name=$1 wanted=$2 titles i=0
  IFS=, read -r -a titles <<<"$3"
  shift 3
  for method; do
    echo "${titles[i]}=$(column "$name" "$method" "$wanted")"
    i=$((i + 1))
  done
}

# The clouds of some methods, as arguments: clouds DIR SUFFIX METHOD...
clouds() {
  local dir=$out/$1 suffix=$2 method
  shift 2
  for method; do echo "$dir/$(safe "$method")$suffix.ply"; done
}

# A comparison of all methods, with pictures of the points and, if wanted, of the surfaces:
# compare_methods NAME TITLE MODEL KIND NOISE SIZE COUNT points|surfaces [RENDER OPTION...]
compare_methods() {
  local name=$1 title=$2 model=$3 kind=$4 noise=$5 size=$6 count=$7 what=$8 points=() meshes=() method titles mean ecov
  shift 8
  measure "$name" "$model" "$kind" "$noise" "$size" "$(join input "${methods[@]}")"
  upsample "$name" "$count" "${methods[@]}"
  for method in "${methods[@]}"; do
    method=$(safe "$method")
    points+=("$out/$name/$method-dense.ply")
    meshes+=("$out/$name/$method-mesh.ply")
  done
  titles=$(join "${labels[@]}")
  draw "$name.png" "input,$titles" "$out/$name/input.ply" "${points[@]}" -- "$@"
  if [[ $what == surfaces ]]; then
    mesh "$name" "${methods[@]}"
    draw "$name-surfaces.png" "$titles" "${meshes[@]}" -- "$@"
  fi
  mapfile -t mean < <(sweep "$name" mean "$titles" "${methods[@]}")
  [[ -n $(column "$name" input ecov) ]] || return 0
  mapfile -t ecov < <(sweep "$name" ecov "$titles" "${methods[@]}")
  "$bars" "$out/$name.svg" "$title" \
    --panel "mean error, 1e-4 diagonal" "input=$(column "$name" input mean)" "${mean[@]}" \
    --panel "edges to nearest point (ecov)" "input=$(column "$name" input ecov)" "${ecov[@]}"
}

figure4() {
  local height=110 literal=() fixed=() omega titles=0.02,0.9,0.99,0.9999,0.999999 file bar fixed_bar
  for omega in ${titles//,/ }; do
    literal+=("paper:repulsion-weight=0+outlier-weight=$omega")
    fixed+=("ours:posterior+keep-outliers+h=20+outlier-weight=$omega")
  done
  measure figure4 plane uniform 0.5 6000 "$(join input "${literal[@]}" "${fixed[@]}")" --outliers 10
  mapfile -t file < <(clouds figure4 "" input "${literal[0]}" "${literal[4]}" "${fixed[0]}" "${fixed[4]}")
  draw figure4.png "input,literal 0.02,literal 0.999999,fixed 0.02,fixed 0.999999" "${file[@]}" \
    -- --view 0,-1,0 --splat 0.4% --zoom 1.6
  mapfile -t bar < <(sweep figure4 mean "$titles" "${literal[@]}")
  mapfile -t fixed_bar < <(sweep figure4 mean "$titles" "${fixed[@]}")
  "$bars" "$out/figure4.svg" "Plane, 0.5 % uniform noise, 10 % outliers: mean error by omega, 1e-4 diagonal" \
    --panel "sigma as printed" "${bar[@]}" --panel "sigma fixed" "${fixed_bar[@]}"
}

figure5() {
  local variants=() mu titles=0,0.1,0.2,0.3,0.5 files bar cover
  for mu in ${titles//,/ }; do variants+=("ours:sample-ratio=0.5+iterations=30+repulsion-weight=$mu"); done
  measure figure5 cube uniform 1 12000 "$(join "${variants[@]}")"
  mapfile -t files < <(clouds figure5 "" "${variants[@]}")
  draw figure5.png "mu ${titles//,/,mu }" "${files[@]}" -- --splat 0.35x --view 0,0,1 --up 0,1,0 --crop-min 0,0,0.8
  mapfile -t bar < <(sweep figure5 mean "$titles" "${variants[@]}")
  mapfile -t cover < <(sweep figure5 cov "$titles" "${variants[@]}")
  "$bars" "$out/figure5.svg" "Cube, 12,000 points, 1 % uniform noise, M = N / 2, repulsion mu" \
    --panel "surface to nearest point (cov)" "${cover[@]}" --panel "mean error, 1e-4 diagonal" "${bar[@]}"
}

figure6() {
  local variants=() ratio titles=0.125,0.25,0.5,1 files bar
  for ratio in ${titles//,/ }; do variants+=("ours:sample-ratio=$ratio"); done
  measure figure6 block uniform 1.5 33490 "$(join "${variants[@]}")"
  truth figure6 block
  upsample figure6 60000 "${variants[@]}"
  mapfile -t files < <(clouds figure6 "" "${variants[@]}")
  draw figure6.png "M = N / 8,M = N / 4,M = N / 2,M = N" "${files[@]}" -- --splat 0.3% --view 0,-1,0 --crop-max 1,0.1,1
  mapfile -t files < <(clouds figure6 -dense "${variants[@]}")
  draw figure6-dense.png "from N / 8,from N / 4,from N / 2,from N" "${files[@]}" --
  mapfile -t bar < <(sweep figure6 mean N/8,N/4,N/2,N "${variants[@]}")
  local methods=("${variants[@]}") labels=(N/8 N/4 N/2 N) dense
  mapfile -t dense < <(accuracy figure6 mean)
  "$bars" "$out/figure6.svg" "Block, 1.5 % uniform noise, M samples" --panel "mean error of the samples" "${bar[@]}" \
    --panel "truth to nearest of 60,000 upsampled" "${dense[@]}"
}

figure7() { compare_methods figure7 "Cube, 3 % uniform noise" cube uniform 3 33490 60000 points; }
figure8() { compare_methods figure8 "Block, 1.5 % uniform noise" block uniform 1.5 33490 60000 surfaces; }
figure9() { compare_methods figure9 "Star, 1 % uniform noise" star uniform 1 75053 100000 surfaces; }

# Figures 13 and 14: a virtual scan, and the paper's error bars. One more method: the same filter told to smooth more.
scanned() {
  local name=$1 title=$2 model=$3 noise=$4 bar mean
  local methods=("${methods[@]}" ours:strength=2) labels=("${labels[@]}" "ours 2x")
  compare_methods "$name" "$title" "$model" scanner "$noise" 33490 60000 points "${@:5}"
  measure "$name-clean" "$model" scanner 0 33490 clean
  mv "$out/$name-clean/clean.ply" "$out/$name/"
  rm -r "$out/$name-clean"
  upsample "$name" 60000 clean
  truth "$name" "$model"
  mapfile -t mean < <(sweep "$name" mean "$(join "${labels[@]}")" "${methods[@]}")
  mapfile -t bar < <(accuracy "$name" mean)
  "$bars" "$out/$name.svg" "$title" --panel "mean error, 1e-4 diagonal" "${mean[@]}" \
    --panel "truth to nearest of 60,000 points, 1e-4 diagonal" "${bar[@]}"
  accuracy "$name" square >"$out/$name/square.txt"
}
figure13() { scanned figure13 "Sphere, scanner noise 1 %" sphere 1; }
figure14() { scanned figure14 "Relief, scanner noise 0.5 %" relief 0.5 --view 0.3,-0.8,1.2 --zoom 1.1; }

figure15() {
  local left right
  [[ -s $out/figure13/square.txt ]] || figure13
  [[ -s $out/figure14/square.txt ]] || figure14
  mapfile -t left <"$out/figure13/square.txt"
  mapfile -t right <"$out/figure14/square.txt"
  "$bars" "$out/figure15.svg" "Mean squared errors, 1e-6 of the squared diagonal" --panel "sphere" "${left[@]}" \
    --panel "relief" "${right[@]}"
}

figure18() {
  local model wanted=(input) titles=input file
  [[ $peers == no ]] || { wanted+=(wlop-best); titles+=,WLOP; }
  wanted+=(paper:outlier-weight=0.9)
  titles+=",literal,ours"
  for model in plane cube; do
    measure "figure18-$model" "$model" uniform 0.5 12000 "$(join "${wanted[@]}")" --outliers 10
    tool filter "$out/figure18-$model/input.ply" -o "$out/figure18-$model/ours.ply" --outliers drop
    mapfile -t file < <(clouds "figure18-$model" "" "${wanted[@]}" ours)
    draw "figure18-$model.png" "$titles" "${file[@]}" -- --splat 0.5% --view 0.3,-1,0.25
  done
}

figure19() { compare_methods figure19 "Block, 3 % uniform noise" block uniform 3 33490 60000 surfaces; }

figure20() {
  local half=ours:sample-ratio=0.5+iterations=30 wanted file
  wanted=(input "$half+plain-repulsion" "$half+repulsion" ours)
  measure figure20 cap uniform 0.5 12000 "$(join "${wanted[@]}")"
  mapfile -t file < <(clouds figure20 "" "${wanted[@]}")
  draw figure20.png "input,eq. 10 repulsion,own tangents,ours" "${file[@]}" -- --splat 0.4% --view 0,-1,0.3
  tool filter tools/demo/box_scan.ply -o "$out/figure20/scan.ply"
  tool filter tools/demo/box_scan.ply -o "$out/figure20/scan-printed.ply" --repulsion 0.3 --own-tangent-repulsion off \
    --iterations 30 --samples 50%
  draw figure20-scan.png "raw,eq. 10 repulsion,ours" tools/demo/box_scan.ply "$out"/figure20/scan{-printed,}.ply --
}

# Gap filling, limitation (iii) of the paper; data weights without normals, as in the paper, make the gaps.
figure21() {
  local dir=$out/figure21 name
  measure figure21 cube uniform 1 12000 input
  tool filter "$dir/input.ply" -o "$dir/without.ply" --normal-angle 90 --outliers keep
  tool filter "$dir/input.ply" -o "$dir/with.ply" --normal-angle 90 --outliers keep --gap-filling 4
  tool filter "$dir/input.ply" -o "$dir/ours.ply" --outliers keep
  for name in without with ours; do
    tool upsample "$dir/$name.ply" -o "$dir/$name-dense.ply" --count 40000
  done
  draw figure21.png "without,with,ours" "$dir"/{without,with,ours}.ply \
    -- --splat 0.35x --view 0,0,1 --up 0,1,0 --crop-min 0,0,0.8
  draw figure21-dense.png "without,with,ours" "$dir"/{without,with,ours}-dense.ply --
}

# Single-threaded, as the paper's machine; RIMLS with its defaults, the tuned settings would count a grid of runs.
table1() {
  local wanted=(rimls) titles=(RIMLS) i size row
  [[ $peers == no ]] || { wanted+=(wlop-half bilateral); titles+=("CGAL WLOP, M = N / 2" "CGAL bilateral"); }
  wanted+=(paper ours:sample-ratio=0.5 ours)
  titles+=("Algorithm 1 as printed, M = N / 2" "ours, M = N / 2" "ours, all points")
  mkdir -p "$out/table1"
  "$quality" --models block --kinds uniform --noises 1.5 --sizes 33490,50629,75053,48305 --threads 1 \
    --methods "$(join "${wanted[@]}")" --csv "$out/table1/records.csv"
  {
    echo "| seconds, one thread | 33,490 | 50,629 | 75,053 | 48,305 |"
    echo "|---|---|---|---|---|"
    for i in "${!wanted[@]}"; do
      row="| ${titles[i]} |"
      for size in 33490 50629 75053 48305; do
        row+=" $(awk -F , -v m="${wanted[i]}" -v n="$size" \
          'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "cpu_s") at = i } $7 == m && $2 == n { printf "%.2f", $at }' \
          "$out/table1/records.csv") |"
      done
      echo "$row"
    done
  } | tee "$out/table1.md"
}

run_figures() {
  local name
  for name in $names; do
    [[ -z $only || ,$only, == *,$name,* ]] || continue
    echo "== $name"
    "$name"
  done
  echo "pictures, bars and tables: $out"
}
run_figures
