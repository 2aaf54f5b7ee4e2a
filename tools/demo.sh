#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs what the build needs, builds the tool, filters the scan in tools/demo and writes before and after into build/demo.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
out=$root/build/demo
tool=$root/build/release/tools/pcl_gpf_tool
scan=$root/tools/demo/box_scan.ply

sh "$root/tools/install_dependencies.sh"

cd "$root"
cmake --preset release -Wno-dev
cmake --build "$root/build/release" --target pcl_gpf_tool

mkdir -p "$out"
cp "$scan" "$out/before.ply"
"$tool" filter "$out/before.ply" -o "$out/after.ply" --overwrite --json "$out/report.json"
"$tool" render "$out/before.ply" "$out/after.ply" -o "$out/before_after.png" --overwrite

echo
echo "before:"
"$tool" info "$out/before.ply" | grep -E '^ *(points|spacing|noise)'
echo "after:"
"$tool" info "$out/after.ply" | grep -E '^ *(points|spacing|noise)'
echo "moved by:"
"$tool" compare "$out/before.ply" "$out/after.ply" --same-order
echo
echo "clouds:  $out/before.ply  $out/after.ply"
echo "picture: $out/before_after.png"
echo "report:  $out/report.json"
