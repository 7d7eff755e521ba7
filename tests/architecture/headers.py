# SPDX-License-Identifier: BSL-1.0
"""usage: headers.py COMPILER INCLUDE JOBS all|changed [FLAG...]    compiles headers alone and names those that fail.

`changed`: those that differ from what Git calls upstream or, where nothing does, that the last commit changed, and those
that include one of them. All, where there is no Git to ask.

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


def git(root, *words):
    run = subprocess.run(["git", "-C", root, *words], text=True, capture_output=True)
    return run.stdout.split("\n")[:-1] if run.returncode == 0 else None


def changed(root, headers):
    """Of `headers`, below root: those that changed and those that include one of them; None if Git does not say."""
    for base in ("@{upstream}", "HEAD~1"):
        # Relative to root, with what is not committed yet; new files are listed apart.
        names = git(root, "diff", "--name-only", "--relative", base, "--", ".")
        new = git(root, "ls-files", "--others", "--exclude-standard", "--", ".")
        if names is None or new is None:
            continue
        touched = {*names, *new}.intersection(headers)
        if touched:
            return [name for name in headers
                    if name in touched or touched.intersection(INCLUDE.findall((root / name).read_text()))]
    # A commit that touched no header is an answer; a copy without history is none.
    return [] if git(root, "rev-parse", "HEAD~1") is not None else None


def main(compiler, include, jobs, which, *flags):
    root = pathlib.Path(include)
    command = [compiler, "-std=c++20", "-I", include, *flags, "-Werror"]
    headers = sorted(path.relative_to(root).as_posix() for path in root.rglob("*.hpp"))
    if not headers:
        print("there are no headers")
        return 1
    if which == "changed" and (some := changed(root, headers)) is not None:
        headers = some
    known = {}
    with tempfile.TemporaryDirectory() as folder:
        core = pathlib.Path(folder) / "core.hpp"
        core.write_text("#include <Eigen/Core>\n")
        if any(leads_to_eigen(header, root, known) for header in headers):
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
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
