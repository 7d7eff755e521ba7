# SPDX-License-Identifier: BSL-1.0
"""Where the scripts under test are, and a way to run them."""
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
REPORT = ROOT / "validation" / "report"
sys.dont_write_bytecode = True
sys.path.insert(0, str(REPORT))


def run(name, *arguments):
    return subprocess.run([sys.executable, "-B", str(REPORT / name), *map(str, arguments)], text=True,
                          capture_output=True, timeout=120)


def write(path, content):
    path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
    return path
