#!/usr/bin/env bash
# Instructions a shadow ray that lightcuts take outside Embree, counted by callgrind (Debian: valgrind): exact, whatever
# else the machine is doing. Prints one line a scene: instructions a ray, rays a point, scene.
#
#   benchmarks/instructions.sh [BUILD] [SCENE...]     BUILD: build/release
#
# OPTIONS (the environment) go to bench-instructions: OPTIONS=--gather benchmarks/instructions.sh
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
build=${1:-$root/build/release}
shift || true
scenes=("$@")
if [ ${#scenes[@]} -eq 0 ]; then
    scenes=("builtin:hall?area-points=64" "builtin:directional?lights=30000" "builtin:surfaces?lights=30000"
        "builtin:surfaces?lights=30000&rotated=0" "builtin:hall?area-points=64&indirect=100000")
fi
command -v valgrind >/dev/null || { echo "instructions.sh: valgrind is missing; install it (Debian: valgrind)" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for scene in "${scenes[@]}"; do
    # shellcheck disable=SC2086  # several options
    rays=$(valgrind --tool=callgrind --callgrind-out-file="$folder/counts" --toggle-collect='shade_receivers*' \
        "$build/bin/bench-instructions" ${OPTIONS:-} "$scene" 2>"$folder/messages") || { cat "$folder/messages" >&2; exit 1; }
    # Own costs by object file; the line after `calls=` repeats what was called.
    awk -v rays="$rays" -v scene="$scene" '
        # A name is written once, after the number that stands for it.
        /^c?ob=/ { id = $0; sub(/^c?ob=/, "", id); sub(/ .*/, "", id)
                   if ($0 ~ / /) { path = $0; sub(/^[^ ]* /, "", path); paths[id] = path }
                   if ($0 ~ /^ob=/) outside = paths[id] !~ /libembree/
                   next }
        /^calls=/ { skip = 1; next }
        /^[0-9+*-]/ { if (!skip && outside) total += $2; skip = 0 }
        END { printf "%7.0f  %10d  %s\n", total / rays, rays, scene }' "$folder/counts"
done
