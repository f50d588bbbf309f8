#!/usr/bin/env bash
# Installs the dependencies, builds everything and runs all tests. Options go to ctest: deploy/test.sh -L unit
#
# ANTIPODE_SHARED names a folder with reference scenes and images; tests that need it are skipped without.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

deploy/install-dependencies.sh
cmake --preset release
cmake --build --preset release
# On a machine without a GPU every rendering test occupies all cores, so more tests at once would only wait for each other.
cores=$(nproc)
exec ctest --preset release --parallel $((cores > 4 ? cores / 2 : 2)) "$@"
