#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Measures what compiling talus costs: user CPU seconds and peak memory of one compiler process at a time, and all the
memory that GCC asks for on the way, a measure of its work that is the same on any machine and day.

The unit is Eigen/Core alone, by which machines and days become comparable. The least of the repeats counts: other
programs can only add to it.
"""
import argparse
import contextlib
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Where Debian keeps Eigen and HDF5.
INCLUDES = ("/usr/include/eigen3", "/usr/include/hdf5/serial")
FLAGS = "-O2 -std=c++20"
UNIT = "Eigen/Core"
# What is always linked with talus::compiled.
COMPILED_ONCE = {ROOT / "examples" / path for path in ("pile.cpp", "pile/plane.cpp", "pile/space.cpp")}
# Keeps GCC from giving memory back: the peak is then all that it asked for.
NO_COLLECTION = ("--param", "ggc-min-expand=1000", "--param", "ggc-min-heapsize=100000000")


class CompileError(Exception):
    pass


class Compiler:
    def __init__(self, name="g++", flags=FLAGS, includes=INCLUDES):
        self.name, self.flags = name, flags
        self.command = [name, *flags.split(), f"-I{ROOT / 'include'}", *(f"-isystem{folder}" for folder in includes)]

    def version(self):
        return subprocess.run([self.name, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]

    def once(self, source, extra=()):
        """User CPU seconds and peak memory [MB] of the compiler and what it starts."""
        if source in COMPILED_ONCE:
            extra = (*extra, "-DTALUS_COMPILED")
        with tempfile.TemporaryFile() as said:
            process = subprocess.Popen([*self.command, *extra, "-c", "-o", os.devnull, "-xc++", str(source)], stdout=said, stderr=said)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode:
                said.seek(0)
                raise CompileError(said.read().decode(errors="replace")[-2000:])
        return {"seconds": usage.ru_utime, "megabytes": usage.ru_maxrss / 1024}

    @contextlib.contextmanager
    def file(self, source):
        """A file, or a text written into one."""
        with tempfile.TemporaryDirectory() as folder:
            if not isinstance(source, pathlib.Path):
                path = pathlib.Path(folder) / "source.cpp"
                path.write_text(source, encoding="utf-8")
                source = path
            yield source

    def measure(self, source, repeats=1):
        """Of a file, or of a text that includes something: the least of some repeats."""
        with self.file(source) as path:
            found = [self.once(path) for _ in range(repeats)]
        return {key: min(one[key] for one in found) for key in found[0]}

    def work(self, source):
        """All memory that GCC asks for [MB]."""
        with self.file(source) as path:
            return self.once(path, NO_COLLECTION)["megabytes"]


def including(headers):
    return "".join(f"#include <{header}>\n" for header in headers)


def folder_programs():
    """Each folder with all headers below it."""
    include = ROOT / "include"
    return {f"talus/{folder.name}": including(sorted(path.relative_to(include) for path in folder.rglob("*.hpp")))
            for folder in sorted((include / "talus").iterdir()) if folder.is_dir()}


def example_programs():
    """The numbered examples and the main job, whose simulations are in two sources of their own."""
    pile = ROOT / "examples" / "pile"
    return {**{path.stem: path for path in sorted((ROOT / "examples").glob("[0-9]*.cpp"))},
            "pile": pile.with_suffix(".cpp"), "pile/plane": pile / "plane.cpp", "pile/space": pile / "space.cpp"}


def header_and_small_program():
    return {"talus.hpp": including(["talus/talus.hpp"]), "small_program": ROOT / "bench" / "small_program.cpp"}


def all_programs():
    return {UNIT: including([UNIT]), **folder_programs(), **header_and_small_program(), **example_programs()}


def table(results):
    unit = results[UNIT]["seconds"]
    lines = [f"{'program':24} {'user CPU [s]':>12} {'/ ' + UNIT:>12} {'peak [MB]':>10}"]
    for name, one in results.items():
        lines.append(f"{name:24} {one['seconds']:12.2f} {one['seconds'] / unit:12.2f} {one['megabytes']:10.0f}")
    return "\n".join(lines)


def add_options(parser):
    parser.add_argument("--compiler", default="g++")
    parser.add_argument("--flags", default=FLAGS, help=f"(default: {FLAGS})")
    parser.add_argument("--include", action="append", metavar="FOLDER", help="of Eigen, of HDF5 (default: Debian's)")


def compiler_of(options):
    return Compiler(options.compiler, options.flags, options.include or INCLUDES)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    add_options(parser)
    parser.add_argument("--repeats", type=int, default=3, help="of each program (default: 3)")
    parser.add_argument("--json", type=pathlib.Path, default=ROOT / "out" / "bench" / "compile_times.json", metavar="OUT")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats must be at least 1")
    compiler = compiler_of(options)
    results, failed = {}, False
    for name, source in all_programs().items():
        try:
            results[name] = compiler.measure(source, options.repeats)
        except CompileError as problem:
            print(f"{name} does not compile:\n{problem}", file=sys.stderr)
            failed = True
            if name == UNIT:
                return 1
    print(f"{compiler.version()}, {options.flags}, least of {options.repeats}\n{table(results)}")
    unit = results[UNIT]["seconds"]
    options.json.parent.mkdir(parents=True, exist_ok=True)
    options.json.write_text(json.dumps({
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "compiler": compiler.version(),
        "flags": options.flags, "machine": platform.machine(), "repeats": options.repeats, "unit": UNIT,
        "programs": {name: {**one, "ratio": one["seconds"] / unit} for name, one in results.items()}}, indent=1) + "\n",
        encoding="utf-8")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
