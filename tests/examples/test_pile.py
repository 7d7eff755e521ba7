#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: test_pile.py PILE ROOT [short | full]    runs the program `pile` on small scenes, right and wrong; `short`: not
until they are at rest, for programs that sanitizers make slow; `full`: also the slow ones.
"""
import json
import os
import pathlib
import re
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml

PILE, ROOT = sys.argv[1], pathlib.Path(sys.argv[2])
SHORT, FULL = ("short" in sys.argv[3:], "full" in sys.argv[3:])
SCENES = ROOT / "examples" / "scenes"

HEAD = "pile 1\ndim 2 shape {shape} n {n}\nbox 0.2 0 0\nmu 0.4 rho 2600 g 9.81 rmean 0.005\n"
DISC = HEAD.format(shape="disc", n=1)
POLYGON = HEAD.format(shape="polygon", n=1)
SQUARE = "0.1 0.1 0.0070710678118654755 4 0.005 -0.005 0.005 0.005 -0.005 0.005 -0.005 -0.005\n"


CERTIFIED, FAILED, WRONG_INPUT, NOT_CERTIFIED = 0, 1, 2, 3


def heed_interrupts():
    """What was started in the background may have been told to ignore them, and would pass that on."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Pile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_pile(self, *arguments, **options):
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.run([PILE, *map(str, arguments)], cwd=self.folder, text=True, timeout=600, check=False, **options)

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
        self.assert_rejected(["'simplex'", "interior_point"], "--solver", "simplex")

    def test_help_teaches(self):
        result = self.run_pile("--help")
        self.assertEqual(result.returncode, 0)
        for word in ("--scene", "--tolerance", "(1e-4)", "(20000)", "[s]", "Examples:", "Exit codes:", "/dev/stdout",
                     "interior_point:"):
            self.assertIn(word, result.stdout)

    def certificate(self, *arguments, code=CERTIFIED):
        result = self.run_pile(*arguments, "--json", "c.json", "--quiet")
        self.assertEqual(result.returncode, code, result.stderr + result.stdout)
        return result.stdout, json.loads((self.folder / "c.json").read_text())[0]

    def check_certificate(self, c, at_rest=not SHORT):
        self.assertEqual((c["steps_missed"], c["impossible"], c["certified"]), (0, [], True))
        self.assertLessEqual(c["worst_residual"], c["tolerance"])
        self.assertLess(c["energy_closure"], 1e-10)
        self.assertEqual(len(c["per_step"]), c["steps"])
        if not at_rest:
            return
        self.assertLess(c["mean_penetration_m"], 0.01 * c["mean_radius_m"])
        self.assertLess(abs(c["reaction_over_weight"] - 1), 1e-3)

    def test_small_piles_settle_with_a_good_certificate(self):
        for scene, at_rest in (("polygons.txt", FULL), ("polyhedra.txt", not SHORT)):
            with self.subTest(scene=scene):
                text, certificate = self.certificate("--scene", SCENES / scene, "--duration", "0.8" if at_rest else "0.1")
                self.check_certificate(certificate, at_rest)
                self.assertRegex(text, r"energy books +close to")

    def test_nothing_impossible_is_found_where_piles_fall(self):
        """Some steps may miss the tolerance there; what cannot be does not happen all the same."""
        for scene in ("discs.txt", "spheres.txt"):
            for how in ((), ("--scheme", "midpoint", "--step", "1e-4"), ("--restitution", "0.5", "--correction", "0.2")):
                with self.subTest(scene=scene, how=how):
                    result = self.run_pile("--scene", SCENES / scene, "--duration", "0.03" if SHORT else "0.12", "--quiet",
                                           "--json", "c.json", *how)
                    certificate = json.loads((self.folder / "c.json").read_text())[0]
                    self.assertEqual(certificate["impossible"], [])
                    self.assertEqual(result.returncode, NOT_CERTIFIED if certificate["steps_missed"] else CERTIFIED)

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
                                             "--max-sweeps", "2", code=NOT_CERTIFIED)
        self.assertGreater(certificate["steps_missed"], 0)
        self.assertGreater(certificate["worst_residual"], certificate["tolerance"])
        self.assertFalse(certificate["certified"])
        self.assertIn(f"{certificate['steps_missed']} missed", text)
        self.assertIn("NOT CERTIFIED", text)
        # When and where it was worst.
        worst = certificate["worst"]["residual"]
        self.assertEqual(worst["value"], certificate["per_step"][worst["step"] - 1]["residual"])
        self.assertRegex(text, rf"worst .* in step {worst['step']} .* between {worst['between'][0]} and {worst['between'][1]}")

    def test_what_cannot_be_is_said(self):
        """A heavy square on light ones, solved badly: it goes through them. (Well: it stands, see below.)"""
        text, certificate = self.certificate(*self.heavy_on_light(), "--tolerance", "1", code=NOT_CERTIFIED)
        self.assertTrue(certificate["impossible"])
        self.assertFalse(certificate["certified"])
        for sentence in certificate["impossible"]:
            self.assertIn(sentence, text)
            self.assertRegex(sentence, r"^[A-Z].*\.$")
        self.assertIn("overlapped by", " ".join(certificate["impossible"]))

    def heavy_on_light(self):
        def square(x, y, side):
            half = side / 2
            corners = ((-half, -half), (half, -half), (half, half), (-half, half))
            return f"{x} {y} {half * 2 ** 0.5:.17g} 4 " + " ".join(f"{a:.17g} {b:.17g}" for a, b in corners) + "\n"
        scene = self.scene(HEAD.format(shape="polygon", n=6).replace("box 0.2", "box 4") +
                           "".join(square(2 + 0.4 * k, 0.0010001, 0.002) for k in range(-2, 3)) +
                           square(2, 1.0020003, 2))
        return "--scene", scene, "--duration", "0.1"

    def test_a_solver_is_chosen_by_name(self):
        for name, restitution in (("gauss_seidel", 0.2), ("interior_point", 0), ("automatic", 0.2)):
            with self.subTest(solver=name):
                _, certificate = self.certificate("--scene", self.scene(POLYGON + SQUARE), "--duration", "0.5", "--solver",
                                                  name, "--restitution", restitution)
                self.check_certificate(certificate)
                self.assertEqual(certificate["solver"], name)

    # Outputs.

    def small(self, *arguments, **options):
        return self.run_pile("--scene", self.scene(POLYGON + SQUARE), "--duration", "0.01", "--quiet", *arguments, **options)

    def test_a_place_where_nothing_can_be_written_is_said_before_the_run(self):
        scene = self.scene(POLYGON + SQUARE)
        (self.folder / "taken").write_text("mine")
        begin = time.monotonic()
        for option in ("--out", "--json"):
            for place in ("taken/deep", "/proc/nowhere/x"):
                self.assert_rejected([option, place], "--scene", scene, option, place, "--duration", "1e6", "--quiet")
        self.assert_rejected(["--json", "directory"], "--scene", scene, "--json", ".", "--duration", "1e6", "--quiet")
        self.assert_rejected(["--out", "taken"], "--scene", scene, "--out", "taken", "--duration", "1e6", "--quiet")
        self.assert_rejected(["--json", "--scene"], "--scene", scene, "--json", scene, "--duration", "1e6", "--quiet")
        self.assertEqual((self.folder / "taken").read_text(), "mine")
        self.assertLess(time.monotonic() - begin, 60)

    def test_trying_outputs_does_not_damage_what_is_there(self):
        (self.folder / "o").mkdir()
        for name in ("o/pile-2d.svg", "c.json"):
            (self.folder / name).write_text("old")
        process = self.start("--scene", self.scene(POLYGON + SQUARE), "--duration", "1e6", "--out", "o", "--json", "c.json")
        process.kill()
        process.communicate()
        self.assertEqual([(self.folder / name).read_text() for name in ("o/pile-2d.svg", "c.json")], ["old", "old"])
        self.assertEqual(sorted(f.name for f in (self.folder / "o").iterdir()), ["pile-2d.svg"])

    def test_figures_may_go_into_the_folder_of_pictures(self):
        result = self.small("--out", "new/o", "--json", "new/o/c.json")
        self.assertEqual(result.returncode, CERTIFIED, result.stderr)
        self.assertEqual(sorted(f.name for f in (self.folder / "new/o").iterdir()),
                         ["c.json", "pile-2d-contacts.vtp", "pile-2d-grains.vtp", "pile-2d.svg"])

    def test_figures_stay_when_pictures_fail(self):
        """The disk is full after so many bytes: the picture of 240 polygons does not fit any more."""
        limit = 20000
        def small_disk():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        result = self.run_pile("--scene", SCENES / "polygons.txt", "--duration", "0.01", "--quiet", "--json", "c.json",
                               preexec_fn=small_disk)
        self.assertEqual(result.returncode, FAILED, result.stderr)
        self.assertIn("pile-2d.svg", result.stderr)
        self.assertEqual(json.loads((self.folder / "c.json").read_text())[0]["steps"], 20)
        self.assertIn("Certificate", result.stdout)
        self.assertEqual(list((self.folder / "pile-out").iterdir()), [])

    @unittest.skipUnless(pathlib.Path("/dev/full").exists(), "no device that is full")
    def test_pictures_stay_when_figures_fail(self):
        result = self.small("--json", "/dev/full")
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("/dev/full", result.stderr)
        self.assertTrue((self.folder / "pile-out/pile-2d.svg").exists())
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = self.small("--json", "c.json", stdout=full)
        self.assertEqual(result.returncode, FAILED)
        self.assertIn("standard output", result.stderr)
        self.assertTrue((self.folder / "c.json").exists())

    def test_figures_alone_on_standard_output(self):
        for name in ("-", "/dev/stdout", "/dev/fd/1"):
            with self.subTest(name=name):
                result = self.small("--json", name)
                self.assertEqual(result.returncode, CERTIFIED, result.stderr)
                self.assertEqual(json.loads(result.stdout)[0]["steps"], 20)
                self.assertIn("Certificate", result.stderr)
                with open(self.folder / "all.txt", "w", encoding="utf-8") as file:
                    file.write("before\n")
                    file.flush()
                    self.small("--json", name, stdout=file)
                    file.seek(0, os.SEEK_END)
                    file.write("after\n")
                before, _, rest = (self.folder / "all.txt").read_text().partition("\n")
                self.assertEqual((before, rest[-6:]), ("before", "after\n"))
                self.assertEqual(json.loads(rest[:-6])[0]["steps"], 20)
        self.assertTrue(pathlib.Path("/dev/stdout").is_symlink())

    def test_links_modes_and_files_of_others_are_kept(self):
        (self.folder / "there.json").write_text("old")
        (self.folder / "there.json").chmod(0o604)
        (self.folder / "c.json").symlink_to("there.json")
        (self.folder / "c.json.part").write_text("mine")
        self.assertEqual(self.small("--json", "c.json").returncode, CERTIFIED)
        self.assertTrue((self.folder / "c.json").is_symlink())
        self.assertEqual(json.loads((self.folder / "there.json").read_text())[0]["steps"], 20)
        self.assertEqual(stat.S_IMODE((self.folder / "there.json").stat().st_mode), 0o604)
        self.assertEqual((self.folder / "c.json.part").read_text(), "mine")

    def test_names_are_shown_without_control_characters(self):
        for arguments in (("--scene", "no\x1b[31m\nfile"), ("--frob\x07",), ("--mu", "\x1b]0;x\x07"),
                          ("--json", "no\x1bfolder/c.json"), ("--out", "/proc/\x1b")):
            result = self.run_pile(*arguments, "--duration", "0.001")
            self.assertEqual(result.returncode, WRONG_INPUT, arguments)
            self.assertNotRegex(result.stderr[:-1], r"[\x00-\x1f\x7f]", arguments)
            self.assertIn("\\x", result.stderr, arguments)
        result = self.small("--out", "o\x1b\xff", "--json", "c.json")
        self.assertEqual(result.returncode, CERTIFIED, result.stderr)
        self.assertNotIn("\x1b", result.stdout)

    # Signals.

    def start(self, *arguments):
        """A run that has made a step."""
        process = subprocess.Popen([PILE, *map(str, arguments)], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, preexec_fn=heed_interrupts)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertRegex(process.stderr.readline(), r"%  (\d+:\d\d(:\d\d)?|[\d.]+ days|[\d.e+]+ years) left")
        return process

    def test_a_signal_ends_the_run_with_what_there_is(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=number):
                process = self.start("--scene", SCENES / "discs.txt", "--duration", "1e6", "--json", "c.json", "--out", number)
                process.send_signal(number)
                out, err = process.communicate(timeout=600)
                self.assertEqual(process.returncode, 128 + number, err)
                certificate = json.loads((self.folder / "c.json").read_text())[0]
                self.assertTrue(certificate["stopped"])
                self.assertGreaterEqual(certificate["steps"], 1)
                self.assertEqual(len(certificate["per_step"]), certificate["steps"])
                self.assertIn(f"{certificate['steps']} before it was stopped", out)
                self.assertEqual(len(list((self.folder / str(int(number))).iterdir())), 3)

    def test_after_a_signal_the_next_pile_is_not_begun(self):
        process = self.start("--count", "30", "--duration", "1e6", "--json", "c.json")
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 130, err)
        self.assertEqual([c["dim"] for c in json.loads((self.folder / "c.json").read_text())], [2])
        self.assertNotIn("3D", out)

    def test_durations_left_are_sane(self):
        process = self.start("--scene", self.scene(POLYGON + SQUARE), "--duration", "1e6", "--step", "1e-9")
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=600)
        process = subprocess.run([PILE, "--scene", self.folder / "scene.txt", "--duration", "8e-4"], cwd=self.folder, text=True,
                                 capture_output=True, timeout=600, check=False)
        self.assertEqual(process.returncode, CERTIFIED)
        self.assertRegex(process.stderr, r"\[#{28}\] 100 %  0:00 left")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
