#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: test_faults.py PILE SHARED    runs the program `pile` with all its defaults on small scenes that were once
answered wrongly: what is right is told in SHARED/faults/README.md.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PILE, FAULTS = sys.argv[1], pathlib.Path(sys.argv[2]) / "faults"
CERTIFIED, NOT_CERTIFIED = 0, 3


@unittest.skipUnless(FAULTS.is_dir(), "data not found")
class Faults(unittest.TestCase):
    def settle(self, scene, duration, *options):
        with tempfile.TemporaryDirectory() as folder:
            command = [PILE, "--scene", FAULTS / scene, "--duration", duration, "--quiet", "--json", "figures.json", *options]
            run = subprocess.run([*map(str, command)], cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 timeout=600, check=False)
            file = pathlib.Path(folder) / "figures.json"
            figures = json.loads(file.read_text())[0] if file.exists() else None
        return run, figures

    def assert_settles(self, scene, duration):
        run, figures = self.settle(scene, duration)
        self.assertEqual(run.returncode, CERTIFIED, f"{scene}: {run.stdout[-2000:]}{run.stderr}")
        return figures

    def test_rounded_prisms_settle(self):
        for scene in ("hexagonal_prism_9_digits.txt", "hexagonal_prism_12_digits.txt"):
            figures = self.assert_settles(scene, 0.6)
            self.assertLess(figures["rms_speed_m_per_s"], 1e-3, scene)

    def test_points_within_faces_are_allowed(self):
        self.assert_settles("cube_with_face_centres.txt", 0.3)

    def test_a_byte_order_mark_is_read_or_named(self):
        run, _ = self.settle("bom.txt", 0.1)
        self.assertTrue(run.returncode == CERTIFIED or "byte order mark" in run.stderr, run.stderr)

    def test_nothing_swallows_another_in_silence(self):
        for scene in ("big_on_small.txt", "big_on_small_open.txt", "big_square_on_small_squares.txt"):
            run, figures = self.settle(scene, 0.3)
            said = f"{scene}: {run.returncode}, {run.stdout[-2000:]}{run.stderr}"
            self.assertIn(run.returncode, (CERTIFIED, NOT_CERTIFIED), said)
            if run.returncode == CERTIFIED:
                deepest = figures["worst"]["overlap_over_half_thickness"]["value"]
                self.assertLessEqual(deepest, 0.1, said)
                self.assertEqual(figures["steps_missed"], 0, said)

    def test_a_tower_of_fifty_stands_at_first(self):
        figures = self.assert_settles("tower_of_50_squares.txt", 0.5)
        self.assertLess(figures["rms_speed_m_per_s"], 1e-2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
