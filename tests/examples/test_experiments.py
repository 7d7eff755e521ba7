# SPDX-License-Identifier: BSL-1.0
"""usage: test_experiments.py FOLDER [full]    experiments, whose programs are in FOLDER, seen from outside.

An experiment that was killed, however often, ends with the bytes of one that was not; what is not asked rightly is
told in one sentence, with nothing written; and each shows, at a small size, what it is there for.
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

FOLDER = None
FULL = False
# Of each experiment its options for runs of a second or so; what cannot be compared between runs is in checkpoint.h5 alone.
SMALL = {
    "conical_pile": [["--dim", 2, "--count", 60, "--rate", 400, "--rest", 0.6], ["--count", 40, "--rate", 400, "--rest", 0.6]],
    "deposit": [["--count", 12, "--width", 5, "--fall", 5, "--rest", 0.1],
                ["--dim", 3, "--count", 12, "--width", 5, "--fall", 5, "--rest", 0.1]],
    "biaxial": [["--count", 30, "--settle", 0.1, "--strain", 0.01, "--probe", 2],
                ["--dim", 3, "--count", 12, "--grains", "round", "--settle", 0.1, "--strain", 0.01, "--probe", 2]],
    "bank": [["--count", 60, "--length", 10, "--plate", 2, "--rest", 0.05, "--rate", 200]],
    "compression": [["--count", 100, "--press", 0.02, "--rest", 0.01, "--fine", 1e-4]],
}


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
        # Once more: the same again.
        again = run(name, *options, "--out", killed)
        self.assertEqual((again.returncode, again.stdout), (through.returncode, through.stdout), again.stderr)
        self.assertEqual(self.files(whole), self.files(killed))

    def test_killed_at_random_moments_it_ends_with_the_same_bytes(self):
        for name, variants in SMALL.items():
            for k, options in enumerate(variants):
                with self.subTest(name=name, options=options):
                    frames = ["--frames", 20] if name == "conical_pile" else []
                    self.killed(name, [*options, *frames], 10 if FULL else 3)
                    self.folder.cleanup()
                    self.path.mkdir()

    def test_numbers_out_of_range_are_refused_and_nothing_is_written(self):
        for name in SMALL:
            out = self.path / "none"
            asked = subprocess.run([str(FOLDER / name), "--help"], capture_output=True, text=True, timeout=60).stdout
            options = re.findall(r"^ +(--[a-z-]+) NUMBER", asked, re.M)
            self.assertGreaterEqual(len(options), 6, asked)
            for option in options:
                for value in ("nan", "much", -1, 1e300):
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

    def test_frictionless_packings_have_as_many_contacts_as_degrees_of_freedom(self):
        text = self.certified("compression", "--count", 100, "--press", 0.6, "--rest", 0.2)
        for contacts, freedom in re.findall(r"mu 0, [^\n]* bearing contacts (\d+), degrees of freedom (\d+)", text):
            self.assertGreater(int(contacts), 0)
            self.assertLessEqual(int(contacts), int(freedom))
            self.assertGreaterEqual(int(contacts), 0.9 * int(freedom))


if __name__ == "__main__":
    FULL = "full" in sys.argv[2:]
    FOLDER = pathlib.Path(sys.argv[1])
    unittest.main(argv=sys.argv[:1], verbosity=2)
