#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: test_solve_problem.py SOLVE_PROBLEM SHARED    runs the program on problem files of SHARED, and on wrong ones."""
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PROBLEMS = sys.argv[1], pathlib.Path(sys.argv[2]) / "problems"
SPATIAL, PLANAR = PROBLEMS / "NESpheres_10_1.hdf5", PROBLEMS / "FrictionContactProblem00071.hdf5"
GLOBAL = PROBLEMS / "CubeH8.hdf5"
HARD = PROBLEMS / "OneObject-i100000-316.hdf5"


class SolveProblem(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_on(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=100, check=False, **options)

    def assert_rejected(self, words, *arguments):
        result = self.run_on(*arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        return result

    def need_problems(self):
        if not PROBLEMS.exists():
            self.skipTest("skipped, data not found")

    def test_wrong_options(self):
        self.assert_rejected(["FILE"])
        self.assert_rejected(["'simplex'", "gauss_seidel"], "a.hdf5", "--solver", "simplex")
        self.assert_rejected(["--tolerance", "'-1'", "[0, 1]"], "a.hdf5", "--tolerance", "-1")
        self.assert_rejected(["--iterations", "'many'"], "a.hdf5", "--iterations", "many")
        self.assert_rejected(["--frobnicate"], "a.hdf5", "--frobnicate")

    def test_help(self):
        result = self.run_on("--help")
        self.assertEqual(result.returncode, 0)
        for word in ("--solver", "--tolerance", "--iterations", "--json", "gauss_seidel"):
            self.assertIn(word, result.stdout)

    def test_a_missing_file(self):
        self.assert_rejected(["nowhere.hdf5", "cannot be read"], "nowhere.hdf5")

    def test_easy_problems_are_solved(self):
        self.need_problems()
        result = self.run_on(SPATIAL, PLANAR, GLOBAL, "--json", "verdict.json")
        self.assertEqual(result.returncode, 0, result.stdout)
        verdict = json.loads((self.folder / "verdict.json").read_text())
        self.assertEqual([(v["name"], v["dimension"], v["contacts"]) for v in verdict],
                         [(SPATIAL.stem, 3, 9), (PLANAR.stem, 2, 89), (GLOBAL.stem, 3, 1)])
        for v in verdict:
            self.assertEqual(v["status"], "converged")
            self.assertLessEqual(v["residual"], 1e-8)
            self.assertLess(v["residual_in_file_units"], 1e-6)
            self.assertIn(v["name"], result.stdout)

    def test_one_missed_tolerance_is_told(self):
        self.need_problems()
        result = self.run_on(SPATIAL, HARD, "--iterations", "5", "--tolerance", "1e-3")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("iteration_limit", result.stdout)

    def test_a_wrong_file_does_not_stop_the_others(self):
        self.need_problems()
        (self.folder / "wrong.hdf5").write_text("no problem")
        result = self.assert_rejected(["wrong.hdf5", "HDF5"], "wrong.hdf5", SPATIAL)
        self.assertIn(SPATIAL.stem, result.stdout)

    def test_damaged_files_are_complained_of_by_the_program_alone(self):
        """The HDF5 library, at the end of a program, speaks of what such files left open; not here."""
        self.need_problems()
        whole, dice = SPATIAL.read_bytes(), random.Random(1)
        for _ in range(60):
            damaged = bytearray(whole)
            for _ in range(dice.choice((1, 3, 20))):
                damaged[dice.randrange(dice.choice((200, 2000, len(damaged))))] = dice.randrange(256)
            (self.folder / "damaged.hdf5").write_bytes(damaged)
            # What HDF5 itself forgets to free is not ours to tell.
            result = self.run_on("damaged.hdf5", "--iterations", "20", env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0"})
            self.assertIn(result.returncode, (0, 1, 2))
            for line in result.stderr.splitlines():
                self.assertTrue(line.startswith("solve_problem: "), line)

    def test_figures_alone_on_standard_output(self):
        self.need_problems()
        for name in ("-", "/dev/stdout"):
            result = self.run_on(SPATIAL, "--json", name)
            self.assertEqual(json.loads(result.stdout)[0]["name"], SPATIAL.stem)
            self.assertIn(SPATIAL.stem, result.stderr)

    def test_figures_that_cannot_be_written_are_said_before_the_work(self):
        self.need_problems()
        result = self.assert_rejected(["nowhere/verdict.json"], SPATIAL, "--json", "nowhere/verdict.json")
        self.assertEqual(result.stdout, "")

    def test_names_are_shown_without_control_characters(self):
        result = self.run_on("no\x1b[31m\nfile")
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("no\\x1b[31m\\nfile", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
