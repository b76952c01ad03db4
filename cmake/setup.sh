# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT
# Sourced by ./demo and ./check: install the packages of packages.txt that are missing, configure, build.

# Install what is missing, as root or through sudo.
install_packages() {
    local package missing=()
    while read -r package; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done < <(grep -vE '^(#|$)' packages.txt)
    [ ${#missing[@]} -eq 0 ] && return
    echo "installing ${missing[*]}"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# build PRESET [TARGET...]
build() {
    local preset=$1 target
    shift
    local targets=()
    for target in "$@"; do
        targets+=(--target "$target")
    done
    if [ ! -f "build/$preset/build.ninja" ]; then
        cmake --preset "$preset"
    fi
    cmake --build --preset "$preset" "${targets[@]}"
}
