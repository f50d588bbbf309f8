#!/usr/bin/env bash
# Has clang-tidy look for mistakes (.clang-tidy) in the sources of library and programs, and ends with 1 where it finds
# any. deploy/check-tidy.sh [BUILD [--last COUNT | FILE…]]: a build folder, build/release without one; the sources that
# the last COUNT commits changed, or files, or all: some four seconds of a core each.
#
# By clang-tidy 16: other versions judge differently, and 14 cannot read the coroutines of GCC's library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=${1:-build/release}
if ! command -v clang-tidy-16 >/dev/null; then
    echo "clang-tidy-16 is missing; deploy/install-dependencies.sh installs it." >&2
    exit 1
fi
if [[ ! -f $build/compile_commands.json ]]; then
    echo "$build holds no compile_commands.json: build there first, for instance with deploy/test.sh." >&2
    exit 1
fi
sources=('renderengine/*.cpp' 'proto/*.cpp' 'terminal/*.cpp' 'farm/*.cpp' 'client/*.cpp' 'server/*.cpp')
files=("${@:2}")
if [[ ${2:-} == --last ]]; then
    # A history that is shorter, or cut short, is looked at from its first commit on.
    since=$(git rev-list --first-parent --max-count=$((${3:?--last takes a number of commits} + 1)) HEAD | tail --lines=1)
    # Which headers are looked at, too, is no matter of other sources.
    checks() { sed '/^HeaderFilterRegex/d'; }
    if [[ $(git show "$since:.clang-tidy" | checks) == $(checks < .clang-tidy) ]]; then
        mapfile -t files < <(git diff --name-only --diff-filter=d "$since" -- "${sources[@]}")
        ((${#files[@]})) || exit 0
    else
        files=()  # other checks concern all sources
    fi
fi
if ((!${#files[@]})); then
    mapfile -t files < <(git ls-files "${sources[@]}")
fi
# The commands are GCC's: its warnings mean nothing to clang, and Asio does not recognise this clang's coroutines.
printf '%s\0' "${files[@]}" | xargs --null --max-procs="$(nproc)" --max-args=1 \
    clang-tidy-16 -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
    --extra-arg=-DASIO_HAS_CO_AWAIT --extra-arg=-DASIO_HAS_STD_COROUTINE \
    --extra-arg=-DBOOST_ASIO_HAS_CO_AWAIT --extra-arg=-DBOOST_ASIO_HAS_STD_COROUTINE 2> >(grep --invert-match 'warnings\? generated' >&2)
