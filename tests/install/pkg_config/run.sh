#!/usr/bin/env bash
# SPDX-License-Identifier: BSL-1.0
# usage: run.sh COMPILER PREFIX SOURCE PROGRAM    compiles with the flags of pkg-config, and runs
set -euo pipefail
command -v pkg-config >/dev/null || {
    echo "skipped, pkg-config not found"
    exit 77
}
flags=$(PKG_CONFIG_PATH=$2/share/pkgconfig pkg-config --cflags talus)
read -r -a flags <<<"$flags"
"$1" "${flags[@]}" "$3" -o "$4"
"$4"
