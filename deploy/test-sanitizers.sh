#!/usr/bin/env bash
# Builds the farm's tests under AddressSanitizer with UBSan and under ThreadSanitizer, those of broken and hostile input files
# under the former alone, and runs them. Options go to ctest.
#
# The tests that render on a device are left out: drivers are no code of ours.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install-dependencies.sh
export ASAN_OPTIONS=detect_leaks=1 TSAN_OPTIONS=halt_on_error=1
run() {  # preset, labels, targets
    cmake --preset "$1"
    cmake --build --preset "$1" --target "${@:3}"
    ctest --preset "$1" --label-regex "$2" --exclude-regex '^OneImage' --parallel 2 "${options[@]}"
}
options=("$@")
run asan 'farm|inputs' farm_tests inputs_test
run tsan farm farm_tests
