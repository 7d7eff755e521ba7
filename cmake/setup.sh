# shellcheck shell=bash
# Shared by tests/run, examples/run, bench/run, validation/run and .ci/run, which source it.
# It sets `root` (the repository), `jobs` (parallel compilations) and defines say, die, ensure_packages.

# A prefix set by the caller would redirect the output of the `cd` below.
unset CDPATH
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${TALUS_JOBS:-$(nproc)}
export root jobs

# The one list of Debian packages: what the library, its tests, examples and benches need.
packages=(
    g++ cmake ninja-build libeigen3-dev                 # the library
    libboost-test-dev libgsl-dev pkg-config python3     # the tests
    libcli11-dev nlohmann-json3-dev librsvg2-bin        # the examples
    libhdf5-dev                                         # problem files: tests and examples
    libbenchmark-dev                                    # the benches
    chromium chromium-driver                            # the test of the validation report
    clang clang-format clang-tidy libclang-rt-14-dev    # the checks
)

say() { printf -- '-- %s\n' "$*"; }

die() {
    printf '%s: %s\n' "${0##*/}" "$*" >&2
    exit "${status:-1}"
}

# Those of `packages` that are not installed, one per line.
missing_packages() {
    local name
    for name in "${packages[@]}"; do
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null) == installed* ]] ||
            printf '%s\n' "$name"
    done
}

# Installs what is missing; does nothing, and needs no network, when nothing is.
ensure_packages() {
    command -v dpkg-query >/dev/null || {
        say "No dpkg on this machine: assuming that the tools are there (${packages[*]})."
        return
    }
    local missing as_root=()
    mapfile -t missing < <(missing_packages)
    ((${#missing[@]})) || return 0
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            die "these packages are missing and installing them needs root or sudo: ${missing[*]}."
        as_root=(sudo)
    fi
    say "Installing ${missing[*]}"
    local log
    log=$(mktemp)
    # A failure is judged by what is still missing, so that one bad mirror among many is no failure.
    {
        "${as_root[@]}" apt-get update -q
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends "${missing[@]}"
    } >"$log" 2>&1 || true
    mapfile -t missing < <(missing_packages)
    if ((${#missing[@]})); then
        tail -n 5 "$log" >&2
        rm -f "$log"
        die "could not install: ${missing[*]}; install them by hand and run this again."
    fi
    rm -f "$log"
}
