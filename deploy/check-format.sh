#!/usr/bin/env bash
# Tells which C++ and GLSL files are not as .clang-format would have them, and ends with 1 where there are any.
# deploy/check-format.sh --fix formats them.
#
# By clang-format 14 alone: other versions format differently.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if (($# > 1)) || [[ ${1:---fix} != --fix ]]; then
    echo "Usage: deploy/check-format.sh [--fix]" >&2
    exit 2
fi
if ! command -v clang-format-14 >/dev/null; then
    echo "clang-format-14 is missing; deploy/install-dependencies.sh installs it." >&2
    exit 1
fi

formatted=$(mktemp)
trap 'rm -f "$formatted"' EXIT
status=0
while IFS= read -r file; do
    # GLSL goes by the rules of C++, whose syntax it shares.
    clang-format-14 --assume-filename="${file%.*}.cpp" <"$file" >"$formatted"
    cmp --silent "$formatted" "$file" && continue
    if (($#)); then
        cat "$formatted" >"$file"
        echo "Formatted $file"
    else
        echo "Not formatted: $file" >&2
        status=1
    fi
done < <(git ls-files '*.h' '*.cpp' '*.comp' '*.glsl')
exit "$status"
