#!/usr/bin/env bash
# Installs the dependencies, builds everything and runs all tests but the slow ones. Options go to ctest and replace that
# choice: deploy/test.sh --label-regex unit; deploy/test.sh --label-regex slow
#
# ANTIPODE_PRESET names another preset of CMakePresets.json than release: ci, where warnings are errors.
# ANTIPODE_SHARED names a folder with reference scenes and images; tests that need it are skipped without.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install-dependencies.sh
preset=${ANTIPODE_PRESET:-release}
cmake --preset "$preset"
cmake --build --preset "$preset"
# On a machine without a GPU every rendering test occupies all cores, so more tests at once would only wait for each other.
cores=$(nproc)
(($#)) || set -- --label-exclude slow
exec ctest --preset "$preset" --parallel $((cores > 4 ? cores / 2 : 2)) "$@"
