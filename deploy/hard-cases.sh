#!/usr/bin/env bash
# Installs the dependencies, builds everything, runs all tests but the farm's, the slow ones too, and writes
# tests/HARD_CASES.md from what they measured. Options go to ctest: deploy/hard-cases.sh --verbose
#
# The page stays as it is where a test fails, where a group of cases is not measured or where a value exceeds its bound.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install-dependencies.sh
cmake --preset release
cmake --build --preset release

ANTIPODE_HARD_CASES=$(mktemp)
export ANTIPODE_HARD_CASES
trap 'rm -f "$ANTIPODE_HARD_CASES"' EXIT
cores=$(nproc)
if ! ctest --preset release --label-exclude farm --parallel $((cores > 4 ? cores / 2 : 2)) "$@"; then
    echo "tests/HARD_CASES.md is left as it is: a test failed." >&2
    exit 1
fi
python3 -B tests/hard_cases.py "$ANTIPODE_HARD_CASES" tests/HARD_CASES.md
