#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Compiles the code in doc comments of the headers and on the pages beside them.

Code in a comment stands five columns behind its slashes. It may use `sim`, a Simulation<3>, `Law`, a
contact law of space, and all names of talus without their namespace.
"""
import argparse
import itertools
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = ROOT / "include"
COMMENT_CODE = re.compile(r"^\s*///     (.*)$")
FUNCTION_TEMPLATE = re.compile(r"^template <int Dim>\n([^;{]*?\))\s*{", re.MULTILINE)
# Besides the header that the code is in.
ALSO = ("talus/talus.hpp", "talus/solver/automatic.hpp", "algorithm", "cstdio")
# What has to be refused, or else this test sees nothing.
WRONG = ("int main() {}", "Simulation<3> sim({.friction = 0.4});", "sim.system().add_obstacle(3.0);")


def comment_blocks(text):
    """Pairs of a line number and code."""
    lines = enumerate(text.splitlines(), start=1)
    for is_code, block in itertools.groupby(lines, key=lambda line: COMMENT_CODE.match(line[1]) is not None):
        block = list(block)
        if is_code and not COMMENT_CODE.match(block[0][1]).group(1).startswith(" "):
            yield block[0][0], "\n".join(COMMENT_CODE.match(line).group(1) for _, line in block)


def instantiations(code):
    """What makes the compiler look into the function templates of a page, in both dimensions."""
    for signature in FUNCTION_TEMPLATE.findall(code):
        for dim in "23":
            made = re.sub(r"(\w+)\(", rf"\1<{dim}>(", signature.strip(), count=1)
            yield f"template {re.sub(r'/[*].*?[*]/', '', made).replace('<Dim>', f'<{dim}>')};"


def page_blocks(text):
    for match in re.finditer(r"```cpp\n(.*?)```", text, re.DOTALL):
        code = match.group(1)
        yield text[:match.start()].count("\n") + 2, "\n".join((code, *instantiations(code)))


def all_blocks():
    """Name, line, code, and whether it stands outside of functions."""
    for path in sorted(INCLUDE.rglob("*.hpp")):
        for line, code in comment_blocks(path.read_text(encoding="utf-8")):
            yield path, line, code, code.startswith("extern template")
    for path in sorted(INCLUDE.rglob("*.md")):
        for line, code in page_blocks(path.read_text(encoding="utf-8")):
            yield path, line, code, True


def program(blocks):
    blocks = list(blocks)
    headers = sorted({str(path.relative_to(INCLUDE)) for path, *_ in blocks if path.suffix == ".hpp"})
    parts = [f"#include <{header}>" for header in (*ALSO, *headers)]
    parts.append("using Law = talus::Coulomb<3>;")
    for k, (path, line, code, outside) in enumerate(blocks):
        where = f'#line {line} "{path}"'
        parts.append(f"{where}\n{code}" if outside else
                     f"namespace block_{k} {{\nusing namespace talus;\n"
                     f"void code([[maybe_unused]] Simulation<3>& sim) {{ {{\n{where}\n{code}\n}} }}\n}}")
    return "\n".join(parts) + "\n"


def compiles(compiler, flags, text):
    result = subprocess.run([compiler, *flags, "-std=c++20", "-fsyntax-only", f"-I{INCLUDE}", "-xc++", "-"],
                            input=text, text=True, capture_output=True, check=False)
    return result.returncode == 0, result.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("flags", nargs="*", help="where Eigen and HDF5 are")
    options = parser.parse_args()
    blocks = list(all_blocks())
    good, said = compiles(options.compiler, options.flags, program(blocks))
    if not good:
        print(said)
        return 1
    for wrong in WRONG:
        if compiles(options.compiler, options.flags, program([(INCLUDE / "talus/talus.hpp", 1, wrong, False)]))[0]:
            print(f"not noticed: {wrong}")
            return 1
    print(f"{len(blocks)} pieces of code compile")
    return 0 if blocks else 1


if __name__ == "__main__":
    sys.exit(main())
