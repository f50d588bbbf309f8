#!/usr/bin/env bash
# Installs what building, testing and running need on Debian 12. Needs root only when something is missing.
set -euo pipefail

packages=(
    # build
    g++ cmake ninja-build git ca-certificates pkg-config glslang-tools protobuf-compiler
    # Vulkan: the loader, drivers (among them lavapipe, which runs on CPUs), checks for the tests
    libvulkan-dev mesa-vulkan-drivers vulkan-validationlayers
    # libraries
    libasio-dev libassimp-dev libboost-dev libcli11-dev libdraco-dev libeigen3-dev libembree-dev libmeshoptimizer-dev libopenexr-dev
    libpng-dev libprotobuf-dev libpugixml-dev libspdlog-dev libssl-dev libstb-dev libtbb-dev libturbojpeg0-dev libwebp-dev
    libxxhash-dev libzstd-dev nlohmann-json3-dev prometheus-cpp-dev
    # plots in the pages of studies
    libjs-chart.js
    # certificates for farms
    openssl
    # tests
    libgtest-dev python3 chromium assimp-testmodels clang libclang-rt-14-dev libfuzzer-14-dev
    # checks of the sources, whose verdicts depend on the version
    clang-format-14 clang-tidy-16
)

missing=()
for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

if ((EUID != 0)); then
    echo "Run this as root to install: ${missing[*]}" >&2
    exit 1
fi
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install -y --no-install-recommends "${missing[@]}"
