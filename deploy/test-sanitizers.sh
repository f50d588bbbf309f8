#!/usr/bin/env bash
# Builds the farm's tests under AddressSanitizer with UBSan and under ThreadSanitizer, and runs them. Options go to ctest.
#
# The tests that render on a device are left out: drivers are no code of ours.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install-dependencies.sh
export ASAN_OPTIONS=detect_leaks=1 TSAN_OPTIONS=halt_on_error=1
for preset in asan tsan; do
    cmake --preset "$preset"
    cmake --build --preset "$preset" --target farm_tests
    ctest --preset "$preset" --label-regex farm --exclude-regex '^OneImage' --parallel 2 "$@"
done
