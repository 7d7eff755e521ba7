#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: test_pile.py PILE ROOT [short]    runs the program `pile` on small scenes, right and wrong; `short`: not until
they are at rest, for programs that sanitizers make slow.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

PILE, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
SHORT = "short" in sys.argv[3:]
SCENES = ROOT / "examples" / "scenes"

HEAD = "pile 1\ndim 2 shape {shape} n {n}\nbox 0.2 0 0\nmu 0.4 rho 2600 g 9.81 rmean 0.005\n"
DISC = HEAD.format(shape="disc", n=1)
POLYGON = HEAD.format(shape="polygon", n=1)
SQUARE = "0.1 0.1 0.0070710678118654755 4 0.005 -0.005 0.005 0.005 -0.005 0.005 -0.005 -0.005\n"


class Pile(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())

    def run_pile(self, *arguments):
        return subprocess.run([PILE, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=600)

    def scene(self, text):
        path = self.folder / "scene.txt"
        path.write_text(text)
        return path

    def assert_rejected(self, words, *arguments):
        """One sentence on standard error that holds all words, exit code 2, nothing written."""
        before = sorted(self.folder.iterdir())
        result = self.run_pile(*arguments)
        said = f"{arguments}: {result.returncode} {result.stderr!r}"
        self.assertEqual(result.returncode, 2, said)
        self.assertEqual(result.stderr.count("\n"), 1, said)
        for word in words:
            self.assertIn(word, result.stderr, said)
        self.assertEqual(sorted(self.folder.iterdir()), before, said)

    def assert_scene_rejected(self, text, *words):
        path = self.scene(text)
        self.assert_rejected(words, "--scene", path, "--json", "c.json", "--quiet")

    def test_a_scene_in_order_is_accepted(self):
        result = self.run_pile("--scene", self.scene(POLYGON + SQUARE), "--duration", "0.01", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_missing_file(self):
        self.assert_rejected(["nowhere.txt", "cannot be read"], "--scene", "nowhere.txt")

    def test_wrong_numbers_in_a_scene(self):
        self.assert_scene_rejected(DISC + "0.1 abc 0.005\n", "line 5:", "abc")
        self.assert_scene_rejected(DISC + "0.1 nan 0.005\n", "line 5:", "nan")
        self.assert_scene_rejected(DISC + "0.1 0.1 -0.005\n", "line 5:", "-0.005", "r [m]")
        self.assert_scene_rejected(DISC + "0.1 0.1\n", "line 5:")
        self.assert_scene_rejected(DISC + "0.1 0.1 0.005 7\n", "line 5:")
        self.assert_scene_rejected(DISC.replace("n 1", "n 2") + "0.1 0.1 0.005\n")

    def test_zero_mass(self):
        self.assert_scene_rejected(DISC.replace("rho 2600", "rho 0") + "0.1 0.1 0.005\n", "line 4:", "rho")

    def test_unknown_key(self):
        self.assert_scene_rejected(DISC.replace("rho", "density") + "0.1 0.1 0.005\n", "line 4:", "density")

    def test_polygon_not_convex(self):
        dart = "0.1 0.1 0.0070710678118654755 4 0.005 -0.005 -0.001 -0.001 -0.005 0.005 -0.005 -0.005\n"
        self.assert_scene_rejected(POLYGON + dart, "line 5:", "convex")

    def test_polygon_with_coincident_vertices(self):
        twice = SQUARE.replace(" 4 ", " 5 ").replace("0.005 -0.005 0.005 0.005", "0.005 -0.005 0.005 0.005 0.005 0.005", 1)
        self.assert_scene_rejected(POLYGON + twice, "line 5:", "coincide")

    def test_overlapping_start(self):
        two = DISC.replace("n 1", "n 2") + "0.1 0.1 0.005\n0.105 0.1 0.005\n"
        self.assert_scene_rejected(two, "line 6:", "overlaps")

    def test_grain_outside_the_box(self):
        self.assert_scene_rejected(DISC + "0.199 0.1 0.005\n", "line 5:")

    def test_wrong_options(self):
        self.assert_rejected(["--mu", "-1", "[0, 1000]"], "--mu", "-1")
        self.assert_rejected(["--step", "nan"], "--step", "nan")
        self.assert_rejected(["--count", "many"], "--count", "many")
        self.assert_rejected(["--count", "2.5", "whole"], "--count", "2.5")
        self.assert_rejected(["--dim", "4"], "--dim", "4")
        self.assert_rejected(["--shape", "cube", "polyhedron"], "--shape", "cube")
        self.assert_rejected(["--shape", "sphere"], "--shape", "sphere", "--dim", "2")
        self.assert_rejected(["--frobnicate"], "--frobnicate")
        self.assert_rejected(["--dim"], "--scene", SCENES / "discs.txt", "--dim", "3")
        self.assert_rejected(["--duration"], "--duration", "1e-6", "--quiet")

    def test_help_teaches(self):
        result = self.run_pile("--help")
        self.assertEqual(result.returncode, 0)
        for word in ("--scene", "--tolerance", "[s]", "Examples:"):
            self.assertIn(word, result.stdout)

    def certificate(self, *arguments):
        result = self.run_pile(*arguments, "--json", "c.json", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout, json.loads((self.folder / "c.json").read_text())[0]

    def check_certificate(self, c):
        self.assertEqual(c["steps_missed"], 0)
        self.assertLessEqual(c["worst_residual"], c["tolerance"])
        self.assertLess(c["energy_closure"], 1e-10)
        self.assertEqual(len(c["per_step"]), c["steps"])
        if SHORT:
            return
        self.assertLess(c["mean_penetration_m"], 0.01 * c["mean_radius_m"])
        self.assertLess(abs(c["reaction_over_weight"] - 1), 1e-3)

    def test_small_piles_settle_with_a_good_certificate(self):
        for scene in ("polygons.txt", "spheres.txt"):
            with self.subTest(scene=scene):
                text, certificate = self.certificate("--scene", SCENES / scene, "--duration", "0.1" if SHORT else "0.8")
                self.check_certificate(certificate)
                self.assertRegex(text, r"energy books +close to")

    def test_pictures_are_well_formed(self):
        for scene in ("discs.txt", "polyhedra.txt"):
            with self.subTest(scene=scene):
                text, _ = self.certificate("--scene", SCENES / scene, "--duration", "0.05")
                files = [self.folder / name for name in re.findall(r"wrote (\S+)", text)]
                self.assertTrue(any(f.suffix == ".svg" for f in files), text)
                self.assertTrue(any(f.suffix == ".vtp" for f in files), text)
                for file in files:
                    if file.suffix in (".svg", ".vtp"):
                        xml.parse(file)

    def test_a_missed_tolerance_is_not_hidden(self):
        text, certificate = self.certificate("--scene", SCENES / "discs.txt", "--duration", "0.3",
                                             "--max-sweeps", "2")
        self.assertGreater(certificate["steps_missed"], 0)
        self.assertGreater(certificate["worst_residual"], certificate["tolerance"])
        self.assertIn(f"{certificate['steps_missed']} missed", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
