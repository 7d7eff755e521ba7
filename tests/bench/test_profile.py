# SPDX-License-Identifier: BSL-1.0
"""profile.py: ratios, profiles and failures of invented runs, and the files made of them."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "profile.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPT.parent))
import profile  # noqa: E402  (not the profiler of the standard library)


def run(problem, solver, seconds, solved=1, tolerance="1e-04", **more):
    return {"name": f"{problem}/{solver}/{tolerance}/iterations:1/manual_time", "run_type": "iteration",
            "real_time": 1e3 * seconds, "time_unit": "ms", "solved": solved, "residual": 1e-5, "contacts": 10.0,
            **more}


# fast wins on p and fails on q; slow solves both; nobody solves s; flat applies to p alone.
RUNS = [run("p", "fast", 1.0), run("p", "slow", 4.0), run("p", "flat", 2.0),
        run("q", "fast", 10.0, solved=0), run("q", "slow", 3.0), run("q", "flat", 0.0, error_occurred=True),
        run("s", "fast", 10.0, solved=0), run("s", "slow", 10.0, solved=0)]
REPORT = {"context": {"processor": "a <b> machine", "limit_seconds": "10.0"}, "benchmarks": RUNS}


class Computation(unittest.TestCase):
    def setUp(self):
        self.results = profile.Results.of(REPORT)

    def ratios(self, solver):
        return profile.ratios(self.results, "1e-04", solver)

    def test_ratio_is_to_the_fastest_that_solved(self):
        self.assertEqual(self.ratios("fast"), [1.0, math.inf, math.inf])
        self.assertEqual(self.ratios("slow"), [1.0, 4.0, math.inf])

    def test_a_problem_a_solver_does_not_apply_to_does_not_count(self):
        self.assertEqual(self.ratios("flat"), [2.0])

    def test_a_problem_nobody_solved_counts_for_all(self):
        self.assertIsNone(profile.best(self.results, "1e-04", "s"))
        self.assertAlmostEqual(profile.profile(self.ratios("slow"), 1e9), 2 / 3)

    def test_profile_counts_ratios_up_to_the_factor(self):
        slow = self.ratios("slow")
        self.assertEqual([profile.profile(slow, f) for f in (1.0, 3.999, 4.0)], [1 / 3, 1 / 3, 2 / 3])

    def test_profile_never_falls(self):
        heights = [y for _, y in profile.curve(self.ratios("slow"), 100.0)]
        self.assertEqual(heights, sorted(heights))
        self.assertEqual(profile.curve(self.ratios("slow"), 100.0)[-1], (100.0, heights[-1]))

    def test_stored_results_say_the_same(self):
        stored = profile.Results.of(json.loads(profile.compact(REPORT)))
        self.assertEqual(stored.time, self.results.time)
        self.assertEqual(stored.context, self.results.context)

    def test_total_counts_failures_at_the_limit(self):
        self.assertAlmostEqual(profile.total(self.results, "1e-04", "fast"), 1.0 + 10.0 + 10.0)

    def test_geometric_mean_is_of_solved_problems(self):
        self.assertAlmostEqual(profile.geometric_mean(self.ratios("slow")), 2.0)
        self.assertIsNone(profile.geometric_mean([math.inf]))

    def test_summary_counts_failures(self):
        rows = {row[0]: row[1:3] for row in profile.summary(self.results, "1e-04")}
        self.assertEqual(rows, {"fast": (1, 2), "slow": (2, 1), "flat": (1, 0)})

    def test_best_of_repetitions_counts_and_aggregates_do_not(self):
        more = [run("p", "slow", 2.0), run("p", "slow", 0.5, solved=0), run("p", "slow", 0.1, run_type="aggregate")]
        results = profile.Results.of({"benchmarks": RUNS + more})
        self.assertAlmostEqual(results.time["1e-04", "p", "slow"], 2.0)

    def test_tolerances_from_loose_to_tight(self):
        report = {"benchmarks": [run("p", "fast", 1.0, tolerance=t) for t in ("1e-12", "1e-03", "1e-06")]}
        self.assertEqual(profile.Results.of(report).tolerances(), ["1e-03", "1e-06", "1e-12"])

    def test_at_most_eight_curves_and_the_best_ones(self):
        runs = [run("p", f"s{k}", k + 1.0) for k in range(12)]
        self.assertEqual(profile.chosen(profile.Results.of({"benchmarks": runs})), [f"s{k}" for k in range(8)])


class Files(unittest.TestCase):
    def make(self, text, *options):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "results.json").write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", SCRIPT, folder / "results.json", folder / "out", *options],
                              text=True, capture_output=True, timeout=120, check=False)
        files = {f.name: f.read_text(encoding="utf-8") for f in (folder / "out").glob("*")}
        return done, files

    def test_svg_is_well_formed_and_has_a_curve_per_solver(self):
        done, files = self.make(json.dumps(REPORT))
        self.assertEqual(done.returncode, 0, done.stderr)
        root = ElementTree.fromstring(files["profile.svg"])
        titles = [t.text for t in root.iter("{http://www.w3.org/2000/svg}title")]
        self.assertEqual(titles, ["fast", "slow", "flat"])

    def test_page_needs_nothing_else_and_escapes(self):
        page = self.make(json.dumps(REPORT))[1]["profile.html"]
        self.assertIn("a &lt;b&gt; machine", page)
        for outside in ("<script", "<link", "src=", "url("):
            self.assertNotIn(outside, page)
        self.assertEqual(page.count('class="failed">failed'), 3)

    def test_text_has_a_line_per_problem(self):
        text = self.make(json.dumps(REPORT))[1]["profile.txt"]
        self.assertRegex(text, r"(?m)^p +1e\+03 \(1\.00\) +4e\+03 \(4\.00\) +2e\+03 \(2\.00\)$")
        self.assertRegex(text, r"(?m)^s +- +-$")

    def test_residuals_that_are_not_numbers_are_read(self):
        done, _ = self.make(json.dumps({"benchmarks": [run("p", "fast", 1.0, residual=math.nan)]}))
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_selection(self):
        self.assertNotIn("fast", self.make(json.dumps(REPORT), "--solvers", "slow|flat")[1]["profile.txt"])

    def test_wrong_files_are_refused(self):
        for text in ("", "{}", '{"benchmarks": [{}]}', '{"benchmarks": []}'):
            done, files = self.make(text)
            self.assertEqual((done.returncode, files), (2, {}))
            self.assertIn("profile.py", done.stderr)


if __name__ == "__main__":
    unittest.main()
