# Sourced by tests/run.sh and examples/demo.sh: which Debian 12 packages each part needs, and how to get them.
# shellcheck shell=bash

library_packages=(g++ cmake ninja-build libglm-dev)
renderer_packages=(
    libembree-dev libtbb-dev libopenexr-dev libstb-dev libcli11-dev
    nlohmann-json3-dev
)
window_packages=(libglfw3-dev libimgui-dev libgl-dev)
test_packages=(
    ccache clang clang-format clang-tidy doxygen libgtest-dev libgmock-dev
    libcgal-dev libeigen3-dev pkgconf libc++-14-dev libc++abi-14-dev
    xvfb xdotool libgl1-mesa-dri
)

fuzz_packages=(clang libclang-rt-14-dev)

# Installs those of the named packages that are not there. Returns 1, having said which failed, if that cannot be done.
install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        echo "This is no Debian system; needed, by Debian's names: $*" >&2
        return 0
    fi
    local package missing=()
    for package in "$@"; do
        if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
            missing+=("$package")
        fi
    done
    if [ ${#missing[@]} -eq 0 ]; then
        return 0
    fi

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "Cannot install without root or sudo: apt-get install ${missing[*]}" >&2
            return 1
        fi
        as_root=(sudo -n)
        if [ -t 0 ]; then
            as_root=(sudo)
        fi
    fi
    local apt=(${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120
               -o Acquire::Retries=3)
    echo "Installing ${missing[*]}"
    local attempt
    for attempt in 1 2 3; do
        if "${apt[@]}" update </dev/null >/dev/null && "${apt[@]}" install -y --no-install-recommends "${missing[@]}" \
            </dev/null >/dev/null; then
            return 0
        fi
        echo "apt-get failed, attempt $attempt of 3" >&2
        sleep $((attempt * 5))
    done
    for package in "${missing[@]}"; do
        if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
            echo "Not installed: $package" >&2
        fi
    done
    return 1
}
