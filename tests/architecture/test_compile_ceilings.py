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

    def __init__(self, unit, program, megabytes=100, work=2.0):
        super().__init__()
        self.lists = {"unit": list(unit), "program": list(program)}
        self.megabytes = megabytes
        self.ratio = work

    def version(self):
        return "invented"

    def once(self, source, extra=()):
        name = "unit" if "Eigen/Core" in source.read_text(encoding="utf-8") else "program"
        if extra == compile_times.NO_COLLECTION:
            return {"seconds": 0.0, "megabytes": 100.0 * (1.0 if name == "unit" else self.ratio)}
        left = self.lists[name]
        return {"seconds": left.pop(0) if len(left) > 1 else left[0], "megabytes": self.megabytes}


def check(compiler, full=True, **table):
    table = {name: compile_ceilings.Ceiling(*ceiling) for name, ceiling in table.items()}
    with contextlib.redirect_stdout(io.StringIO()) as said:
        kept = compile_ceilings.check(compiler, table, full)
    return kept, said.getvalue()


class Ceilings(unittest.TestCase):
    def test_a_program_below_its_ceilings_passes(self):
        self.assertTrue(check(Invented([1], [2]), small_program=(2.1, 2.5, 1024))[0])

    def test_too_much_work_fails_and_names_the_program(self):
        for full in (False, True):
            kept, said = check(Invented([1], [2]), full, small_program=(1.9, 2.5, 1024))
            self.assertFalse(kept)
            self.assertRegex(said, r"small_program +work +2\.00 of at most +1\.90 units  TOO MUCH")

    def test_time_and_memory_count_in_full_alone(self):
        for ceiling in ((2.1, 1.9, 1024), (2.1, 2.5, 99)):
            self.assertTrue(check(Invented([1], [2]), False, small_program=ceiling)[0])
            kept, said = check(Invented([1], [2]), True, small_program=ceiling)
            self.assertFalse(kept)
            self.assertEqual(said.count("TOO MUCH"), 1)

    def test_one_above_its_ceiling_among_others_fails(self):
        kept, said = check(Invented([1], [2]), **{"talus.hpp": (2.5, 2.5, 1024), "small_program": (0.1, 2.5, 1024)})
        self.assertFalse(kept)
        self.assertEqual(said.count("TOO MUCH"), 1)

    def test_the_smaller_unit_counts(self):
        # twice before, once after
        self.assertFalse(check(Invented([2, 2, 1], [3]), small_program=(2.1, 2, 1024))[0])
        self.assertFalse(check(Invented([2, 1, 2], [3]), small_program=(2.1, 2, 1024))[0])

    def test_a_disturbed_measurement_gets_another_chance(self):
        self.assertTrue(check(Invented([1], [3, 3, 2]), small_program=(2.1, 2.5, 1024))[0])

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

    def test_work_is_the_same_in_every_run(self):
        text = "#include <vector>\nint f() { std::vector<int> v(3); return v[0]; }\n"
        first, second = (compile_times.Compiler().work(text) for _ in range(2))
        self.assertLess(abs(first / second - 1.0), 0.01)
        self.assertGreater(compile_times.Compiler().work("#include <map>\n" + text), 1.02 * first)


if __name__ == "__main__":
    unittest.main()
