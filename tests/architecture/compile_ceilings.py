#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Fails when compiling a program takes more work than it may, in units of Eigen/Core alone.

Work is all the memory that GCC asks for: what it reads, instantiates and optimises passes through it, and it is the
same in every run. User CPU time, which other programs on the machine change by a half, and peak memory are held to
ceilings with --full only.
"""
import argparse
import collections
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import compile_times  # noqa: E402

Ceiling = collections.namedtuple("Ceiling", "work seconds megabytes")
# Of work and time as multiples of Eigen/Core's, with GCC -O2. Work is some 3 % below its ceiling, time some 30 %.
# Lower them when the library gets lighter.
CEILINGS = {
    "talus.hpp":            Ceiling(1.25, 3.6, 1024),
    "small_program":        Ceiling(2.5, 11, 1024),
    "01_ball_drop":         Ceiling(3.67, 18, 1024),
    # with --full alone
    "02_block_on_incline":  Ceiling(5.75, 23, 1024),
    "03_own_shape":         Ceiling(5.2, 21, 1024),
    "04_own_law":           Ceiling(6.6, 25, 1024),
    "05_own_solver":        Ceiling(5.35, 24, 1024),
    "06_watch_convergence": Ceiling(1.95, 6, 1024),
    "07_hopper":            Ceiling(6.3, 26, 1024),
    "08_drum":              Ceiling(6.0, 26, 1024),
    "09_shaking_table":     Ceiling(5.5, 24, 1024),
    "10_angle_of_repose":   Ceiling(7.9, 30, 1024),
    "11_woodpecker":        Ceiling(3.2, 12, 1024),
    # with talus::compiled, which they are always linked with
    "pile":                 Ceiling(4.95, 19, 1024),  # options, JSON
    "pile/plane":           Ceiling(4.4, 24, 1024),  # a whole simulation, a solver chosen by name, pictures
    "pile/space":           Ceiling(4.65, 32, 1024),
}
DEFAULT = ("talus.hpp", "small_program", "01_ball_drop")


def ceilings(full):
    return {name: ceiling for name, ceiling in CEILINGS.items() if full or name in DEFAULT}


def line(name, what, found, most, unit):
    """Whether a figure keeps below its ceiling, and a line about it."""
    kept = found <= most
    return kept, f"{name:24} {what} {found:7.2f} of at most {most:7.2f} {unit}{'' if kept else '  TOO MUCH'}"


def check_work(compiler, table, programs):
    unit = compiler.work(programs[compile_times.UNIT])
    for name, ceiling in table.items():
        yield line(name, "work  ", compiler.work(programs[name]) / unit, ceiling.work, "units")


def check_time(compiler, table, programs):
    """The unit is compiled beside each program, and the least counts: other programs on the machine only add. What is
    too slow all the same is tried again, twice at most."""
    core = programs[compile_times.UNIT]
    unit = compiler.measure(core, repeats=2)["seconds"]
    for name, ceiling in table.items():
        one = compiler.measure(programs[name])
        for _ in range(2):
            if one["seconds"] <= ceiling.seconds * unit:
                break
            again = compiler.measure(programs[name])
            one = {key: min(one[key], again[key]) for key in one}
        unit = min(unit, compiler.measure(core)["seconds"])
        yield line(name, "time  ", one["seconds"] / unit, ceiling.seconds, "units")
        yield line(name, "memory", one["megabytes"], ceiling.megabytes, "MB")


def check(compiler, table, full):
    """True if all keep below."""
    programs = compile_times.all_programs()
    print(f"{compiler.version()}, {compiler.flags}; unit: {compile_times.UNIT}")
    kept = True
    for one_kept, text in (*check_work(compiler, table, programs),
                           *(check_time(compiler, table, programs) if full else ())):
        print(text, flush=True)
        kept &= one_kept
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    compile_times.add_options(parser)
    parser.add_argument("--full", action="store_true", help="all examples, their time and peak memory")
    options = parser.parse_args()
    return 0 if check(compile_times.compiler_of(options), ceilings(options.full), options.full) else 1


if __name__ == "__main__":
    sys.exit(main())
