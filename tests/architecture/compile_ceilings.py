#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Fails when compiling a program takes more user CPU time, in units of Eigen/Core alone, or more memory than it may.

Without --full only DEFAULT.
"""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import compile_times  # noqa: E402

# Some 20 to 35 % above what was measured first, on a busy machine.
# User CPU time over that of Eigen/Core, and peak memory [MB], both with GCC -O2. Lower them when the library gets lighter.
CEILINGS = {
    # program               units    MB
    "talus.hpp":            (3.6,  1024),
    "small_program":        (10,   1024),
    "01_ball_drop":         (16,   1024),
    # with --full alone
    "02_block_on_incline":  (18,   1024),
    "03_own_shape":         (18,   1024),
    "04_own_law":           (19,   1024),
    "05_own_solver":        (20,   1024),
    "06_watch_convergence": (6,    1024),
    "pile":                 (60,   1600),  # both dimensions, several solvers, pictures and files
}
DEFAULT = ("talus.hpp", "small_program", "01_ball_drop")


def ceilings(full):
    return {name: ceiling for name, ceiling in CEILINGS.items() if full or name in DEFAULT}


def verdicts(measured, unit, table):
    """Of each program whether it keeps below its ceilings, and a line about it."""
    for name, (units, megabytes) in table.items():
        one = measured[name]
        ratio = one["seconds"] / unit
        kept = ratio <= units and one["megabytes"] < megabytes
        yield kept, (f"{name:24} {ratio:6.2f} of at most {units:5.2f} units, {one['megabytes']:5.0f} of {megabytes} MB"
                     f"{'' if kept else '  TOO MUCH'}")


def check(compiler, table):
    """True if all keep below; the unit is compiled before and after, as the machine may change its pace, and the smaller counts."""
    programs = compile_times.all_programs()
    core = programs[compile_times.UNIT]
    compiler.measure(core)  # the first reads from the disk
    before = compiler.measure(core)["seconds"]
    measured = {name: compiler.measure(programs[name]) for name in table}
    unit = min(before, compiler.measure(core)["seconds"])
    print(f"{compiler.version()}, {compiler.flags}; unit: {compile_times.UNIT}, {unit:.2f} s")
    found = list(verdicts(measured, unit, table))
    # Other programs on the machine only add: what is too slow gets a second chance, next to units of its own.
    if not all(kept for kept, _ in found):
        unit = min(unit, compiler.measure(core)["seconds"])
        for name, (kept, _) in zip(table, found):
            if not kept:
                again = compiler.measure(programs[name])
                measured[name] = {key: min(again[key], measured[name][key]) for key in again}
        unit = min(unit, compiler.measure(core)["seconds"])
        found = list(verdicts(measured, unit, table))
    print("\n".join(line for _, line in found))
    return all(kept for kept, _ in found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    compile_times.add_options(parser)
    parser.add_argument("--full", action="store_true", help="all examples")
    options = parser.parse_args()
    return 0 if check(compile_times.compiler_of(options), ceilings(options.full)) else 1


if __name__ == "__main__":
    sys.exit(main())
