# SPDX-License-Identifier: BSL-1.0
"""compile_ceilings.py notices what is above its ceiling (invented times), compile_times.py measures the compiler itself."""
import contextlib
import io
import sys
import unittest

sys.dont_write_bytecode = True
import compile_ceilings  # noqa: E402
import compile_times  # noqa: E402


class Invented(compile_times.Compiler):
    """Each compilation takes what the lists say, one after the other; the last is repeated."""

    def __init__(self, unit, program, megabytes=100):
        super().__init__()
        self.lists = {"unit": list(unit), "program": list(program)}
        self.megabytes = megabytes

    def version(self):
        return "invented"

    def once(self, source):
        left = self.lists["unit" if "Eigen/Core" in source.read_text(encoding="utf-8") else "program"]
        return {"seconds": left.pop(0) if len(left) > 1 else left[0], "megabytes": self.megabytes}


def check(compiler, table):
    with contextlib.redirect_stdout(io.StringIO()) as said:
        kept = compile_ceilings.check(compiler, table)
    return kept, said.getvalue()


class Ceilings(unittest.TestCase):
    def test_a_program_below_its_ceiling_passes(self):
        self.assertTrue(check(Invented([1], [2]), {"talus.hpp": (2.5, 1024)})[0])

    def test_a_ceiling_of_a_tenth_fails_and_names_the_program(self):
        kept, said = check(Invented([1], [2]), {"talus.hpp": (0.1, 1024)})
        self.assertFalse(kept)
        self.assertRegex(said, r"talus\.hpp +2\.00 of at most +0\.10 units.*TOO MUCH")

    def test_one_above_its_ceiling_among_others_fails(self):
        kept, said = check(Invented([1], [2]), {"talus.hpp": (2.5, 1024), "small_program": (0.1, 1024)})
        self.assertFalse(kept)
        self.assertEqual(said.count("TOO MUCH"), 1)

    def test_too_much_memory_fails(self):
        self.assertFalse(check(Invented([1], [2], megabytes=1024), {"talus.hpp": (2.5, 1024)})[0])

    def test_the_smaller_unit_counts(self):
        # first, before, after
        self.assertFalse(check(Invented([9, 2, 1], [3]), {"talus.hpp": (2, 1024)})[0])
        self.assertFalse(check(Invented([9, 1, 2], [3]), {"talus.hpp": (2, 1024)})[0])

    def test_a_disturbed_measurement_gets_a_second_chance(self):
        self.assertTrue(check(Invented([1], [3, 2]), {"talus.hpp": (2.5, 1024)})[0])

    def test_full_has_a_ceiling_for_every_example(self):
        full = compile_ceilings.ceilings(True)
        self.assertLessEqual(set(compile_times.example_programs()) | set(compile_ceilings.DEFAULT), set(full))
        self.assertLessEqual(set(full), set(compile_times.all_programs()))


class Measured(unittest.TestCase):
    def test_a_program_that_does_not_compile_is_an_error_with_the_compiler_s_words(self):
        with self.assertRaisesRegex(compile_times.CompileError, "here it is"):
            compile_times.Compiler().measure("#error here it is\n")

    def test_time_and_memory_are_those_of_the_compiler_itself(self):
        # A loop that the compiler runs: the driver alone takes a hundredth of a second and 3 MB.
        text = "constexpr int f() { int s = 0; for (int i = 0; i < 200000; ++i) s ^= i; return s; } static_assert(f() == 0);\n"
        one = compile_times.Compiler().measure(text)
        self.assertGreater(one["seconds"], 0.03)
        self.assertGreater(one["megabytes"], 10)


if __name__ == "__main__":
    unittest.main()
