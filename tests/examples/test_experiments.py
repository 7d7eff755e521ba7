# SPDX-License-Identifier: BSL-1.0
"""usage: test_experiments.py CONICAL_PILE    experiments seen from outside.

An experiment that was killed, however often, ends with the bytes of one that was not; what is not asked rightly is
told in one sentence, with nothing written.
"""
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

CONICAL_PILE = None


def run(*options, **how):
    return subprocess.run([CONICAL_PILE, *map(str, options)], capture_output=True, text=True, timeout=600, **how)


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

    def small(self, dim, *options, rest=1.2):
        count = 60 if dim == 2 else 40
        return ["--dim", dim, "--count", count, "--rate", 400, "--rest", rest, "--quiet", "--frames", 20, *options]

    def test_killed_at_ten_random_moments_it_ends_with_the_same_bytes(self):
        for dim in (2, 3):
            whole, killed = self.path / f"whole{dim}", self.path / f"killed{dim}"
            begin = time.monotonic()
            through = run(*self.small(dim, "--out", whole))
            seconds = time.monotonic() - begin
            self.assertEqual(through.returncode, 0, through.stdout + through.stderr)
            lot = random.Random(7)
            for _ in range(10):
                program = subprocess.Popen([CONICAL_PILE, *map(str, self.small(dim, "--out", killed, "--save-every", 0))],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(lot.uniform(0.0, seconds))
                program.send_signal(signal.SIGKILL)
                program.wait()
            last = run(*self.small(dim, "--out", killed))
            self.assertEqual(last.returncode, 0, last.stdout + last.stderr)
            self.assertEqual(last.stdout, through.stdout)
            for name in ("checkpoint.h5", "rings.csv", "heap.svg", "movie.jsonl"):
                self.assertEqual((whole / name).read_bytes(), (killed / name).read_bytes(), name)
            # Once more: all is over, and stays as it is.
            again = run(*self.small(dim, "--out", killed))
            self.assertEqual((again.returncode, again.stdout), (0, through.stdout))
            for name in ("rings.csv", "heap.svg", "movie.jsonl"):
                self.assertEqual((whole / name).read_bytes(), (killed / name).read_bytes(), name)

    def test_the_ground_carries_the_heap(self):
        result = run(*self.small(3, "--out", self.path / "heap"))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        share = float(result.stdout.split("the ground carries ")[1].split()[0])
        self.assertAlmostEqual(share, 1.0, delta=0.02)
        self.assertIn("certified", result.stdout)
        frames = [json.loads(line) for line in (self.path / "heap/movie.jsonl").read_text().splitlines()]
        self.assertEqual(frames[0]["format"], "talus movie")
        self.assertGreater(sum("time" in frame for frame in frames), 20)

    def test_a_stop_is_told_by_the_exit_code_and_gone_on_from(self):
        out = self.path / "stopped"
        program = subprocess.Popen([CONICAL_PILE, *map(str, self.small(3, "--out", out, rest=50))],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(1.5)
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=60)
        self.assertEqual(program.returncode, 130)
        self.assertTrue((out / "checkpoint.h5").exists())
        self.assert_sentence(run(*self.small(3, "--mu", 0.3, "--out", out, rest=50)), "experiment is", "--fresh")

    def test_numbers_out_of_range_are_refused_and_nothing_is_written(self):
        out = self.path / "none"
        for option, value in (("--dim", 4), ("--dim", 2.5), ("--count", 1), ("--radius", 0), ("--mu", -1),
                              ("--rate", "fast"), ("--step", 0), ("--rest", "nan"), ("--rain", 2), ("--rain", 0.5), ("--count", 20.5), ("--frames", -1),
                              ("--seed", -1), ("--save-every", -1)):
            self.assert_sentence(run("--out", out, option, value), option, "must be")
            self.assertFalse(out.exists())
        self.assert_sentence(run("--colour", "red"), "--colour")
        self.assert_sentence(run("--out", "/proc/nowhere"), "--out")
        file = self.path / "damaged"
        file.mkdir()
        (file / "checkpoint.h5").write_bytes(b"no checkpoint")
        self.assert_sentence(run("--out", file), "checkpoint.h5", "--fresh")
        self.assertEqual((file / "checkpoint.h5").read_bytes(), b"no checkpoint")


if __name__ == "__main__":
    CONICAL_PILE = sys.argv.pop(1)
    unittest.main(verbosity=2)
