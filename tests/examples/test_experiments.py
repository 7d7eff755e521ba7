# SPDX-License-Identifier: BSL-1.0
"""usage: test_experiments.py FOLDER [full|short]    experiments, whose programs are in FOLDER, seen from outside.

An experiment that was killed, however often, ends with the bytes of one that was not; what is not asked rightly is
told in one sentence, with nothing written; and each shows, at a small size, what it is there for. In short, for programs
that are slow: the conical pile alone.
"""
import json
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FOLDER = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else None
FULL, SHORT = "full" in sys.argv[2:], "short" in sys.argv[2:]
# Of each experiment its options for runs of a second or so; what cannot be compared between runs is in checkpoint.h5 alone.
SMALL = {
    "arch": [["--voussoirs", 8, "--duration", 0.2], ["--dim", 3, "--voussoirs", 8, "--duration", 0.1]],
    "ballast": [["--grains", 60, "--sleepers", 3, "--rest", 0.05]],
    "bank": [["--count", 30, "--length", 10, "--plate", 2, "--rest", 0.05, "--rate", 200, "--step", 5e-4]],
    "biaxial": [["--count", 30, "--settle", 0.1, "--strain", 0.01, "--probe", 2],
                ["--dim", 3, "--count", 12, "--grains", "round", "--settle", 0.1, "--strain", 0.01, "--probe", 2]],
    "card_house": [["--storeys", 1, "--apart", 0.01, "--duration", 0.05]],
    "column": [["--count", 40, "--aspects", "1,2", "--settle", 0.3]],
    "compression": [["--count", 100, "--press", 0.02, "--rest", 0.01, "--fine", 1e-4]],
    "conical_pile": [["--count", 40, "--rate", 400, "--rest", 0.6], ["--dim", 2, "--count", 60, "--rate", 400, "--rest", 0.6]],
    "deposit": [["--count", 12, "--width", 5, "--fall", 5, "--rest", 0.1],
                ["--dim", 3, "--count", 12, "--width", 5, "--fall", 5, "--rest", 0.1]],
    "dominoes": [["--rows", 1, "--count", 6, "--narrow", 0.45, "--wide", 0.45]],
    "drum": [["--radius", 6, "--creep", 0.5, "--flow", 0.5]],
    "hourglass": [["--width", 9, "--height", 1.2, "--openings", "5,6", "--measure", 0.2, "--lead", 0.1, "--empty", 0.2, "--settle", 0.2]],
    "silo": [["--width", 5, "--height", 3, "--rest", 0.1, "--sink", 0.2]],
    "stone_wall": [["--dim", 2, "--courses", 2, "--stones", 2, "--quake", 1, "--blow", 0.1]],
    "tower": [["--rate", 2, "--stand", 0.1, "--after", 0.1, "--layers", 4, "--layer", 2]],
}
if SHORT:
    SMALL = {"conical_pile": SMALL["conical_pile"]}


def command(name, *options):
    return [str(FOLDER / name), *map(str, options), "--quiet"]


def run(name, *options):
    return subprocess.run(command(name, *options), capture_output=True, text=True, timeout=600)


def number(pattern, text):
    found = re.search(pattern, text)
    assert found, f"{pattern} is not in:\n{text}"
    return float(found[1])


class Experiments(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def assert_sentence(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def certified(self, name, *options):
        """What a run prints that can be believed."""
        result = run(name, *options, "--out", self.path / name)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertRegex(result.stdout, "(?m)^certified: ")
        return result.stdout

    def files(self, folder):
        """All that a run has written, but the place where it would go on, and what was being written when it was killed."""
        return {str(file.relative_to(folder)): file.read_bytes()
                for file in sorted(folder.rglob("*")) if file.is_file() and file.name != "checkpoint.h5" and file.suffix != ".part"}

    def killed(self, name, options, times):
        whole, killed = self.path / f"{name}-whole", self.path / f"{name}-killed"
        begin = time.monotonic()
        through = run(name, *options, "--out", whole)
        seconds = time.monotonic() - begin
        self.assertIn(through.returncode, (0, 3), through.stdout + through.stderr)
        lot = random.Random(7)
        for _ in range(times):
            program = subprocess.Popen(command(name, *options, "--out", killed, "--save-every", 0),
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(lot.uniform(0.0, seconds))
            program.send_signal(signal.SIGKILL)
            program.wait()
        last = run(name, *options, "--out", killed)
        self.assertEqual((last.returncode, last.stdout), (through.returncode, through.stdout), last.stderr)
        self.assertGreater(len(self.files(whole)), 2)
        self.assertEqual(list(self.files(whole)), list(self.files(killed)))
        for file, bytes_ in self.files(whole).items():
            self.assertEqual(bytes_, self.files(killed)[file], f"{name}: {file}")
        if not FULL:
            return
        # Once more: the same again.
        again = run(name, *options, "--out", killed)
        self.assertEqual((again.returncode, again.stdout), (through.returncode, through.stdout), again.stderr)
        self.assertEqual(self.files(whole), self.files(killed))

    def test_killed_at_random_moments_it_ends_with_the_same_bytes(self):
        for name, variants in SMALL.items():
            for options in variants if FULL else variants[:1]:
                with self.subTest(name=name, options=options):
                    frames = ["--frames", 20] if name == "conical_pile" else []
                    self.killed(name, [*options, *frames], 10 if FULL else 1)
                    self.folder.cleanup()
                    self.path.mkdir()

    def test_numbers_out_of_range_are_refused_and_nothing_is_written(self):
        values = ("nan", "much", -1, 1e300) if FULL else ("nan", 1e300)
        for name in SMALL:
            out = self.path / "none"
            asked = subprocess.run([str(FOLDER / name), "--help"], capture_output=True, text=True, timeout=60).stdout
            options = re.findall(r"^ +(--[a-z-]+) NUMBER", asked, re.M)
            self.assertGreaterEqual(len(options), 6, asked)
            for option in options:
                for value in values:
                    self.assert_sentence(run(name, "--out", out, option, value), option, "must be")
            for option in re.findall(r"^ +(--[a-z-]+) WORD", asked, re.M):
                self.assert_sentence(run(name, "--out", out, option, "red"), option, "must be one of")
            self.assert_sentence(run(name, "--out", out, "--colour", "red"), "--colour")
            self.assertFalse(out.exists())
        self.assert_sentence(run("conical_pile", "--out", out, "--count", 20.5), "--count", "whole number")
        self.assert_sentence(run("conical_pile", "--out", "/proc/nowhere"), "--out")
        file = self.path / "damaged"
        file.mkdir()
        (file / "checkpoint.h5").write_bytes(b"no checkpoint")
        self.assert_sentence(run("conical_pile", "--out", file), "checkpoint.h5", "--fresh")
        self.assertEqual((file / "checkpoint.h5").read_bytes(), b"no checkpoint")

    def test_a_stop_is_told_by_the_exit_code_and_gone_on_from(self):
        out, options = self.path / "stopped", [*SMALL["conical_pile"][1][:-1], 50]
        program = subprocess.Popen(command("conical_pile", *options, "--out", out), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.5)
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=60)
        self.assertEqual(program.returncode, 130)
        self.assertTrue((out / "checkpoint.h5").exists())
        self.assert_sentence(run("conical_pile", *options, "--mu", 0.3, "--out", out), "experiment is", "--fresh")

    def test_the_ground_carries_the_heap(self):
        text = self.certified("conical_pile", *SMALL["conical_pile"][1][:-1], 1.2, "--frames", 20)
        self.assertAlmostEqual(number("the ground carries ([0-9.]+)", text), 1.0, delta=0.02)
        frames = [json.loads(line) for line in (self.path / "conical_pile/movie.jsonl").read_text().splitlines()]
        self.assertEqual(frames[0]["format"], "talus movie")
        self.assertGreater(sum("time" in frame for frame in frames), 20)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_frictionless_packings_have_as_many_contacts_as_degrees_of_freedom(self):
        result = run("compression", "--count", 100, "--press", 0.8, "--rest", 0.2, "--out", self.path / "packing")
        found = re.findall(r"mu ([0-9.]+), (\d+) grains[^\n]* bearing contacts (\d+), degrees of freedom (\d+)", result.stdout)
        self.assertEqual(len(found), 12, result.stdout + result.stderr)
        for mu, grains, contacts, freedom in found:
            if int(grains) < 40:
                continue  # they may crystallise
            if float(mu) == 0.0:  # two of a hundred: overlaps that were left
                self.assertAlmostEqual(int(contacts), int(freedom), delta=0.02 * int(freedom), msg=result.stdout)
            else:
                self.assertLess(int(contacts), 0.97 * int(freedom), result.stdout)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_an_arch_stands_above_its_least_thickness_and_falls_below(self):
        text = self.certified("arch", "--voussoirs", 10, "--duration", 0.6, "--dim", 3)
        self.assertAlmostEqual(number("of an arch of 10 voussoirs: ([0-9.]+)", text), 0.10746, delta=1e-5)
        above, below = (re.search(rf"{share} +(\w+) +([0-9.]+) ", text) for share in ("1.0200", "0.9800"))
        self.assertEqual((above[1], below[1]), ("equilibrium", "moving"))
        self.assertLess(float(above[2]), 0.01)
        self.assertGreater(float(below[2]), 100)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_a_house_of_cards_needs_the_friction_of_statics(self):
        text = self.certified("card_house", "--storeys", 1, "--apart", 0.01, "--duration", 0.5)
        self.assertAlmostEqual(number("one-step test: ([0-9.]+)", text) / number("by statics: ([0-9.]+)", text), 1, delta=1e-3)
        stands, falls = (number(rf"{share} +([0-9.]+) ", text) for share in ("1.0100", "0.9900"))
        self.assertLess(stands, 1e-3)
        self.assertGreater(falls, 10)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_dominoes_fall_at_the_speed_of_theory_at_any_size(self):
        text = self.certified("dominoes", "--rows", 1, "--count", 20, "--narrow", 0.45, "--wide", 0.45)
        measured, theory = re.search(r"48 +0.4500 +[0-9.]+ +([0-9.]+) +([0-9.]+)", text).groups()
        self.assertAlmostEqual(float(measured) / float(theory), 1, delta=0.02)
        self.assertAlmostEqual(number(r"speed/sqrt\(gh\) is ([0-9.]+) times", text), 1, delta=0.005)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_a_course_of_stones_slips_as_newmarks_block(self):
        text = self.certified("stone_wall", "--dim", 2, "--courses", 1, "--stones", 1, "--peak", 1.0, "--mu", 0.4, "--quake", 4,
                              "--gust", 0, "--blow", 0.001)
        self.assertAlmostEqual(number(r"base course: (-[0-9.]+) mm", text) / number(r"earthquake: (-[0-9.]+) mm", text), 1, delta=0.01)

    @unittest.skipIf(SHORT, "of the conical pile alone")
    def test_flows_of_grains(self):
        janssen = self.certified("silo", "--width", 5, "--height", 3, "--rest", 0.1, "--sink", 0.3)
        self.assertTrue(0.4 <= number("K = ([0-9.]+)", janssen) <= 1.0, janssen)
        column = self.certified("column", "--count", 40, "--aspects", "1,2,4", "--settle", 0.3)
        reach = [float(x) for x in re.findall(r"(?m)^ *[0-9.]+ +([0-9.]+) +[0-9.]+ +[0-9.]+$", column)]
        self.assertEqual((len(reach), reach), (3, sorted(reach)), column)
        drum = self.certified("drum", "--radius", 6, "--creep", 0.5, "--flow", 1)
        self.assertTrue(10 < number("fast: .* leans by ([0-9.]+)", drum) < 40, drum)
        hourglass = self.certified("hourglass", "--width", 9, "--height", 1.2, "--openings", "5,7", "--measure", 0.3, "--lead", 0.1,
                                   "--empty", 0.2, "--settle", 0.3)
        self.assertLess(number(r"opening +5.00 d: ([0-9.e-]+)", hourglass), number(r"opening +7.00 d: ([0-9.e-]+)", hourglass))

    @unittest.skipUnless(FULL, "takes minutes")
    def test_long_ones(self):
        text = self.certified("tower", "--rate", 0.5, "--stand", 0.5, "--after", 0.5)
        self.assertRegex(text, "stands")
        text = self.certified("ballast", "--grains", 250, "--sleepers", 3)
        self.assertGreater(number("Gini[^0-9]*([0-9.]+)", text), 0.3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
