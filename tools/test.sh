#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, configures, builds and runs every test.
#   tools/test.sh         with the default compiler, optimised
#   tools/test.sh --all   with GCC, with Clang, and with the address and undefined-behaviour sanitizers;
#                         warnings are errors
# The last line is "N passed, M failed", summed over the builds. A build that fails counts as one failed test.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

presets=(release)
install_options=()
case "${1-}" in
  "") ;;
  --all)
    presets=(ci-gcc ci-clang asan)
    install_options=(--all)
    ;;
  *)
    echo "usage: $0 [--all]" >&2
    exit 2
    ;;
esac

tools/install_dependencies.sh ${install_options[@]+"${install_options[@]}"}

jobs=$(nproc)
passed=0
failed=0
failed_tests=()

# Adds the figures of CTest's JUnit file to the sums; skipped tests count neither way. Keeps the names of failed tests.
add_results() {
  local head number
  head=$(grep -m 1 -A 10 '<testsuite' "$1" | tr '\n' ' ' | sed 's/>.*//')
  declare -A count
  for number in tests failures skipped disabled; do
    count[$number]=$(sed -n "s/.*[[:space:]]$number=\"\([0-9]*\)\".*/\1/p" <<<"$head")
  done
  local name
  while IFS= read -r name; do
    failed_tests+=("$2: $name")
  done < <(sed -n 's/.*<testcase name="\([^"]*\)".*status="fail".*/\1/p' "$1")
  failed=$((failed + count[failures]))
  passed=$((passed + count[tests] - count[failures] - count[skipped] - count[disabled]))
}

run_preset() {
  local preset=$1 results="$PWD/build/$1/test_results.xml" started=$SECONDS
  echo "== $preset: configure"
  cmake --preset "$preset" -Wno-dev || return 1
  echo "== $preset: build"
  cmake --build --preset "$preset" -j "$jobs" || return 1
  echo "== $preset: test ($((SECONDS - started)) s so far)"
  rm -f "$results"
  ctest --preset "$preset" -j "$jobs" --output-junit "$results" || true
  [[ -s $results ]] || return 1
  add_results "$results" "$preset"
  echo "== $preset: done in $((SECONDS - started)) s"
}

for preset in "${presets[@]}"; do
  if ! run_preset "$preset"; then
    echo "== $preset: FAILED before its tests could run" >&2
    failed=$((failed + 1))
  fi
done

# At the end, where the part of a long log that people are shown has them.
for failure in ${failed_tests[@]+"${failed_tests[@]}"}; do
  echo "FAILED $failure"
done

echo "$passed passed, $failed failed"
[[ $failed -eq 0 && $passed -gt 0 ]]
