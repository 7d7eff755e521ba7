# shellcheck shell=bash
# Shared by tests/run, examples/run, bench/run, validation/run and .ci/run, which source it.
# It sets `root` (the repository), `jobs` (parallel compilations) and defines say, die, ensure_packages.

# A prefix set by the caller would redirect the output of the `cd` below.
unset CDPATH
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${TALUS_JOBS:-$(nproc)}
export root jobs

# The one list of packages, by what needs them. A package may be in several groups. They are Debian's, but for
# npm:NAME@VERSION, of which Debian has none that is new enough: they go to build/npm, for this repository alone.
declare -A packages=(
    [library]="g++ cmake ninja-build libeigen3-dev"
    [examples]="libcli11-dev nlohmann-json3-dev libhdf5-dev"
    [tests]="libboost-dev libboost-test-dev pkg-config python3" # which build the examples too
    [browser]="chromium chromium-driver"                     # for the page of the validation report
    [player]="python3 npm:three@0.170.0"                     # for movies of space; those of the plane need python3 alone
    [bench]="libbenchmark-dev libcli11-dev libhdf5-dev python3"
    [validation]="libgsl-dev libcli11-dev nlohmann-json3-dev python3"
    [clang]="clang libclang-rt-14-dev"
    [checks]="clang-format clang-tidy"
)

say() { printf -- '-- %s\n' "$*"; }

die() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit "${status:-1}"
}

# The packages of some groups, one per line; `all` is every group.
packages_of() {
    local group list=''
    for group in "$@"; do
        if [[ $group == all ]]; then
            list+=" ${packages[*]}"
        else
            list+=" ${packages[$group]:?there is no such group of packages: $group}"
        fi
    done
    # shellcheck disable=SC2086  # words are wanted
    printf '%s\n' $list | sort -u
}

npm_folder=$root/build/npm

# has_of_npm NAME@VERSION: whether it is in that folder.
has_of_npm() {
    grep -qsF "\"version\": \"${1##*@}\"" "$npm_folder/node_modules/${1%@*}/package.json"
}

# install_of_npm NAME@VERSION...: no scripts of theirs are run.
install_of_npm() {
    mkdir -p "$npm_folder"
    npm install --prefix "$npm_folder" --no-package-lock --ignore-scripts --no-audit --no-fund "$@"
}

# Those of the given packages that are not installed, one per line.
missing_of() {
    local name
    for name in "$@"; do
        if [[ $name == npm:* ]]; then
            has_of_npm "${name#npm:}" || printf '%s\n' "$name"
            continue
        fi
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null) == installed* ]] ||
            printf '%s\n' "$name"
    done
}

install_of_debian() {
    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || {
            echo "installing needs root or sudo"
            return 1
        }
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$@"
}

# ensure_packages GROUP...: installs what is missing; does nothing, and needs no network, when nothing is.
ensure_packages() {
    (($#)) || die "ensure_packages needs a group of packages, or 'all'."
    local wanted
    wanted=$(packages_of "$@") || die "in ensure_packages $*"
    mapfile -t wanted <<<"$wanted"
    command -v dpkg-query >/dev/null || {
        say "No dpkg on this machine: assuming that the tools are there (${wanted[*]})." >&2
        return
    }
    local missing
    mapfile -t missing < <(missing_of "${wanted[@]}")
    ((${#missing[@]})) || return 0
    say "Installing ${missing[*]}" >&2
    local log debian=() of_npm=() name
    for name in "${missing[@]}"; do
        if [[ $name == npm:* ]]; then of_npm+=("${name#npm:}"); else debian+=("$name"); fi
    done
    if ((${#of_npm[@]})) && ! command -v npm >/dev/null; then debian+=(npm); fi
    log=$(mktemp)
    # A failure is judged by what is still missing, so that one bad mirror among many is no failure.
    if ((${#debian[@]})); then install_of_debian "${debian[@]}" >"$log" 2>&1 || true; fi
    if ((${#of_npm[@]})); then install_of_npm "${of_npm[@]}" >>"$log" 2>&1 || true; fi
    mapfile -t missing < <(missing_of "${wanted[@]}")
    if ((${#missing[@]})); then
        tail -n 5 "$log" >&2
        rm -f "$log"
        die "could not install: ${missing[*]}; install them by hand and run this again."
    fi
    rm -f "$log"
}
