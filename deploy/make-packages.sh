#!/usr/bin/env bash
# Builds packages of client, server and library for the Debian that this runs on, in build/packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
type -P dpkg-shlibdeps > /dev/null || { echo "Install dpkg-dev, which finds what the packages depend on." >&2; exit 1; }

deploy/install-dependencies.sh
cmake --preset release -B build/packages -D ANTIPODE_BUILD_TESTS=OFF -D ANTIPODE_ZSH_FOLDER=zsh/vendor-completions
cmake --build build/packages
(cd build/packages && cpack)
