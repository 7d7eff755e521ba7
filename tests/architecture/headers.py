# SPDX-License-Identifier: BSL-1.0
"""usage: headers.py COMPILER INCLUDE JOBS [FLAG...]    compiles every header alone and names those that fail.

Most of the time of a header alone goes into reading Eigen/Core. Headers that lead to it by their own
includes, and only those, find it precompiled: what it declares they may use anyway. A header that uses
Eigen and does not lead to it is compiled without, and fails.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

INCLUDE = re.compile(r"^#\s*include\s*<([^>]+)>", re.MULTILINE)


def leads_to_eigen(header, root, known):
    """Whether `header`, a path below root, includes Eigen's core directly or through other headers."""
    if header not in known:
        known[header] = False
        for target in INCLUDE.findall((root / header).read_text()):
            if target.startswith("Eigen/"):
                known[header] = True
            elif (root / target).exists() and leads_to_eigen(target, root, known):
                known[header] = True
    return known[header]


def main(compiler, include, jobs, *flags):
    root = pathlib.Path(include)
    command = [compiler, "-std=c++20", "-I", include, *flags, "-Werror"]
    headers = sorted(path.relative_to(root).as_posix() for path in root.rglob("*.hpp"))
    known = {}
    with tempfile.TemporaryDirectory() as folder:
        core = pathlib.Path(folder) / "core.hpp"
        core.write_text("#include <Eigen/Core>\n")
        pch = core.with_suffix(".hpp.gch" if "clang" not in compiler else ".hpp.pch")
        subprocess.run([*command, "-x", "c++-header", core, "-o", pch], check=True)

        def check(header):
            use = ["-include", core] if leads_to_eigen(header, root, known) else []
            run = subprocess.run([*command, *use, "-fsyntax-only", "-x", "c++", "-"], text=True, capture_output=True,
                                 input=f"#include <{header}>\n#include <{header}>\n")
            return header, run.returncode, run.stderr

        failed = 0
        with concurrent.futures.ThreadPoolExecutor(int(jobs)) as pool:
            for header, code, text in pool.map(check, headers):
                if code:
                    failed += 1
                    print(f"{header} does not compile alone:\n{text}")
    print(f"{len(headers) - failed} of {len(headers)} headers compile alone")
    return 1 if failed or not headers else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
