#!/usr/bin/env bash
# Builds the fuzz targets and runs each for so many seconds: deploy/test-fuzz.sh [SECONDS]   (default 60)
#
# Ends with a status other than 0 when one finds something; the input is then in build/fuzz/findings/. To see it again:
# build/fuzz/tests/fuzz/TARGET build/fuzz/findings/TARGET-…
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}

targets=(frame_fuzz block_codec_fuzz scene_fuzz checkpoint_fuzz importer_fuzz)

deploy/install-dependencies.sh
cmake --preset fuzz
cmake --build --preset fuzz --target fuzzers
mkdir -p build/fuzz/findings

found=0
for target in "${targets[@]}"; do
    echo "== $target, $seconds s"
    # New inputs go to the first folder and stay there for the next run.
    mkdir -p "build/fuzz/corpus/$target"
    "build/fuzz/tests/fuzz/$target" -max_total_time="$seconds" -max_len=65536 -rss_limit_mb=2048 -timeout=20 \
        -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$target-" \
        "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" || found=1
done
exit "$found"
