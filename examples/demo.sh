#!/usr/bin/env bash
# Builds the renderer and renders a picture: examples/demo.sh [SCENE] [options of lightcuts-render]
# Installs what is missing on Debian 12. The picture goes to build/demo/: render.exr, render.png and render.json.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/.ci/packages.sh"
install_packages "${library_packages[@]}" "${renderer_packages[@]}"

build=$root/build/demo-build
pictures=$root/build/demo
cmake -S "$root" -B "$build" -G Ninja -D CMAKE_BUILD_TYPE=Release -D LIGHTCUTS_TESTS=OFF -D LIGHTCUTS_BENCHMARKS=OFF \
    -D LIGHTCUTS_EXAMPLES=OFF -D LIGHTCUTS_RENDERER=ON -D LIGHTCUTS_DOCS=OFF >/dev/null
cmake --build "$build" --target lightcuts-render

mkdir -p "$pictures"
output=(--output "$pictures/render.exr")
for argument in "$@"; do
    case $argument in
        # What writes no picture, or one elsewhere.
        -o* | --output* | -h | --help | --version | --list-scenes) output=() ;;
    esac
done
"$build/bin/lightcuts-render" "${output[@]}" "$@"
if [ ${#output[@]} -gt 0 ]; then
    echo "Written: $pictures/render.exr, render.png and render.json"
fi
