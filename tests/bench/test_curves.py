# SPDX-License-Identifier: BSL-1.0
"""curves.py: points and ends of invented runs, and the drawing made of them."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "curves.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPT.parent))
import curves  # noqa: E402
from profile import Results  # noqa: E402


def run(solver, tolerance, seconds, residual, solved=1):
    return {"name": f"p/{solver}/{tolerance}/iterations:1/manual_time", "run_type": "iteration",
            "real_time": 1e3 * seconds, "time_unit": "ms", "solved": solved, "residual": residual, "contacts": 10.0}


# sure arrives everywhere, stuck ends at 3e-5, never_there gains nothing worth a point.
REPORT = {"context": {"processor": "a <b> machine", "limit_seconds": "10.0"},
          "benchmarks": [run("stuck", "1e-02", 0.2, 9e-3), run("stuck", "1e-04", 0.3, 9e-5),
                         run("stuck", "1e-06", 10.0, 3e-5, solved=0), run("sure", "1e-02", 0.5, 9e-3),
                         run("sure", "1e-04", 0.6, 9e-5), run("sure", "1e-06", 0.75, 9e-7),
                         run("never_there", "1e-02", 10.0, 1.0, solved=0)]}


class Curves(unittest.TestCase):
    def setUp(self):
        self.found = curves.curves(Results.of(REPORT), "p")

    def test_points_are_the_tolerances_reached(self):
        self.assertEqual(self.found["sure"], ([(0.5, 1e-2), (0.6, 1e-4), (0.75, 1e-6)], None))

    def test_a_failure_ends_where_it_was_stopped(self):
        self.assertEqual(self.found["stuck"], ([(0.2, 1e-2), (0.3, 1e-4)], (10.0, 3e-5)))

    def test_without_a_point_there_is_no_curve(self):
        self.assertNotIn("never_there", self.found)

    def test_the_best_comes_first(self):
        self.assertEqual(curves.best_first(self.found), ["sure", "stuck"])


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "r.json").write_text(json.dumps(REPORT), encoding="utf-8")

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *map(str, arguments)], capture_output=True, text=True,
                              timeout=60)

    def test_the_drawing_is_svg_with_a_curve_per_solver(self):
        out = self.folder / "c.svg"
        self.assertEqual(self.run_script(self.folder / "r.json", "p", out).returncode, 0)
        root = ElementTree.parse(out).getroot()
        lines = root.findall("{http://www.w3.org/2000/svg}polyline")
        self.assertEqual([len(line.get("points").split()) for line in lines], [3, 2])

    def test_an_unknown_problem_is_one_sentence(self):
        result = self.run_script(self.folder / "r.json", "q", self.folder / "c.svg")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))
        self.assertIn("'q'", result.stderr)

    def test_a_wrong_file_is_one_sentence(self):
        (self.folder / "r.json").write_text("[]", encoding="utf-8")
        result = self.run_script(self.folder / "r.json", "p", self.folder / "c.svg")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
