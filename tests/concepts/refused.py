# SPDX-License-Identifier: BSL-1.0
"""usage: refused.py COMPILERS FOLDER INCLUDE EIGEN [NAME...]

Compiles every FOLDER/*.cpp (or those named) with each of COMPILERS (a list with semicolons; those that
are not there are left out) and checks that each is refused, in at most five lines of error and note, with every word of its `// expect: word` lines
among them. So a wrong law, shape or solver is answered with what it lacks.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MOST_LINES = 5
# A line that names a place in a file: the compilers' hints about their own options are no part of it.
DIAGNOSTIC = re.compile(r"^\S+:\d+:\d+: (?:fatal )?(?:error|note):.*$", re.MULTILINE)


def precompiled(compiler, includes, folder):
    """Options with which programs find all of talus read already: most of what each of them takes."""
    header = pathlib.Path(folder) / "all.hpp"
    header.write_text("#include <talus/talus.hpp>\n")
    clang = "clang" in pathlib.Path(compiler).name
    result = f"{header}.{'pch' if clang else 'gch'}"
    subprocess.run([compiler, "-std=c++20", *includes, "-x", "c++-header", header, "-o", result], check=True)
    return ["-include-pch", result] if clang else ["-include", header]


def complaint(compiler, path, includes):
    """What is wrong with the refusal of the program at `path`; empty if nothing is."""
    expected = re.findall(r"^// expect: (.+)$", path.read_text(), re.MULTILINE)
    if not expected:
        return "no '// expect: word' line"
    stop = "-ferror-limit=1" if "clang" in pathlib.Path(compiler).name else "-fmax-errors=1"
    run = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", stop, *includes, path],
                         capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"})
    lines = DIAGNOSTIC.findall(run.stderr)
    if run.returncode == 0:
        return "compiles"
    missing = [word for word in expected if not any(word in line for line in lines[:MOST_LINES])]
    if missing:
        return f"does not name {', '.join(missing)}:\n" + run.stderr
    if len(lines) > MOST_LINES:
        return f"takes {len(lines)} lines:\n" + run.stderr
    return ""


def main(compilers, folder, include, eigen, *names):
    includes = ["-I", include, *(part for path in eigen.split(";") for part in ("-isystem", path))]
    programs = sorted(pathlib.Path(folder).glob("*.cpp"))
    if names:
        programs = [path for path in programs if path.stem in names]
    failed = not programs or not any(shutil.which(compiler) for compiler in compilers.split(";"))
    for compiler in compilers.split(";"):
        if not shutil.which(compiler):
            print(f"{compiler} is not there", flush=True)
            continue
        with tempfile.TemporaryDirectory() as scratch:
            options = [*includes, *precompiled(compiler, includes, scratch)]
            for path in programs:
                # A macro that headers see must come before them.
                wrong = complaint(compiler, path, includes if "#define" in path.read_text() else options)
                failed |= bool(wrong)
                print(f"{path.stem}, {compiler}: {wrong or 'refused'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
