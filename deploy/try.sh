#!/usr/bin/env bash
# Installs the dependencies, builds the renderer and renders the README's still life to glass_caustics.exr and .png here.
# Options are those of 'antipode render' and replace the ones below: deploy/try.sh --radius-factor 8 --time 600
set -euo pipefail
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$repository/deploy/install-dependencies.sh"
(cd "$repository" && cmake --preset release && cmake --build --preset release --target antipode)

(($#)) || set -- --width 640 --height 360 --iterations 100 --radius-factor 8
exec "$repository/build/release/client/antipode" render "$repository/scenes/glass_caustics.textproto" "$@"
