# SPDX-License-Identifier: BSL-1.0
"""usage: format.py CLANG_FORMAT ROOT    fails when a source file is not formatted as .clang-format says"""
import pathlib
import subprocess
import sys

tool, root = sys.argv[1], pathlib.Path(sys.argv[2])
files = sorted(str(f) for folder in ("include", "tests", "examples", "bench", "validation")
               for f in (root / folder).rglob("*.[ch]pp"))
sys.exit(subprocess.run([tool, "--dry-run", "--Werror", *files], check=False).returncode)
