#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""laboratory.py runs experiments for each seed, once, holds their findings against what is asked, and keeps reports whole."""
import contextlib
import io
import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "validation/laboratory"), str(ROOT / "validation/report"), str(pathlib.Path(__file__).resolve().parent)]
import laboratory  # noqa: E402
import report_file  # noqa: E402
import sample_report  # noqa: E402

# An experiment that finds its seed, ten times of it, and says how many steps it missed.
EXPERIMENT = """#!/usr/bin/env python3
import pathlib, sys
arguments = dict(zip(sys.argv[1::2], sys.argv[2::2]))
out, seed = pathlib.Path(sys.argv[sys.argv.index("--out") + 1]), int(sys.argv[sys.argv.index("--seed") + 1])
with open(pathlib.Path(sys.argv[0]).parent / "begun", "a") as log:
    log.write(f"{sys.argv[1:]}\\n")
shift = float(sys.argv[sys.argv.index("--shift") + 1]) if "--shift" in sys.argv else 0.0
out.mkdir(parents=True)
(out / "findings.csv").write_text(f"finding,unit,value\\nseed,-,{seed + shift}\\nten times,m,{10 * seed}\\nnothing,-,nan\\n")
print("not certified: 1000 steps, MISSED missed the tolerance")
if CODE == 2:
    print("wrong: seed is wrong", file=sys.stderr)
sys.exit(CODE)
"""


def case(checks, runs=None):
    return {"id": "G99", "name": "invented", "title": "Invented", "class": "T", "setup": "", "reference": [], "compared": "",
            "why": "", "source": "", "dims": {"2": {"runs": runs or {"main": {"experiment": "invented"}}, "checks": checks}}}


class Laboratory(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.program(0)

    def program(self, code, missed=0):
        path = self.folder / "invented"
        path.write_text(EXPERIMENT.replace("CODE", str(code)).replace("MISSED", str(missed)))
        path.chmod(0o755)

    def begun(self):
        return len((self.folder / "begun").read_text().splitlines())

    def tried(self, *checks, runs=None, seeds=(1, 2, 3)):
        one = case(list(checks), runs)
        self.work = tempfile.TemporaryDirectory()
        self.addCleanup(self.work.cleanup)
        made = laboratory.Runs(self.folder, self.work.name, 2)
        result = laboratory.try_case(one["dims"]["2"], made, list(seeds))
        result["dim"] = 2
        return one, result

    def outcome(self, check, **more):
        result = self.tried(check, **more)[1]
        self.assertEqual(result["error"], "")
        return result["checks"][-1]["passed"], result["verdict"]

    def test_what_is_asked_holds_or_not(self):
        for asked, holds in (({"expected": 2, "bound": 0.001}, True), ({"expected": 2.1, "bound": 0.05}, False),
                             ({"at_least": 2}, True), ({"at_least": 2.01}, False), ({"at_most": 2}, True),
                             ({"at_most": 1.99}, False), ({"pooled_at_least": 6 / math.sqrt(3) - 1e-9}, True),
                             ({"pooled_at_least": 6 / math.sqrt(3) + 1e-3}, False)):
            with self.subTest(asked):
                self.assertEqual(self.outcome({"finding": "seed", **asked}), (holds, "passed" if holds else "failed"))

    def test_a_number_that_is_none_fails(self):
        for asked in ({"expected": 0, "bound": 1e9}, {"at_least": -1e9}, {"at_most": 1e9}, {"pooled_at_least": -1e9}):
            with self.subTest(asked):
                self.assertEqual(self.outcome({"finding": "nothing", **asked}), (False, "failed"))

    def test_a_run_is_compared_with_another_of_the_same_seed(self):
        runs = {"main": {"experiment": "invented", "options": ["--shift", "0.5"]}, "other": {"experiment": "invented"}}
        self.assertTrue(self.outcome({"finding": "seed", "less": "other", "expected": 0.5, "bound": 1e-12}, runs=runs)[0])
        self.assertTrue(self.outcome({"finding": "seed", "of": "other", "expected": 2, "bound": 1e-12}, runs=runs)[0])

    def test_runs_that_several_ask_for_are_made_once(self):
        runs = {"main": {"experiment": "invented"}, "again": {"experiment": "invented"}}
        self.tried({"finding": "seed", "at_least": 0}, runs=runs)
        self.assertEqual(self.begun(), 3)

    def test_steps_that_missed_count(self):
        for missed, verdict in ((1, "passed"), (2, "failed")):
            with self.subTest(missed):
                self.program(3, missed)
                self.assertEqual(self.outcome({"finding": "seed", "at_least": 0})[1], verdict)

    def test_what_fails_is_an_error_with_its_words(self):
        self.program(2)
        result = self.tried({"finding": "seed", "at_least": 0})[1]
        self.assertEqual(result["verdict"], "error")
        self.assertIn("wrong: seed is wrong", result["error"])
        self.program(0)
        result = self.tried({"finding": "unheard of", "at_least": 0})[1]
        self.assertEqual((result["verdict"], result["error"]), ("error", "'unheard of' is not among the findings"))

    def test_reports_stay_whole(self):
        path = self.folder / "report.json"
        path.write_text(json.dumps(sample_report.sample(sound=True)))
        before = report_file.load(path)
        results = len(list(report_file.rows(before)))
        one, result = self.tried({"finding": "seed", "at_least": 0}, {"finding": "ten times", "expected": 20, "bound": 1})
        laboratory.add_to(before, one, result)
        laboratory.write(before, path)
        after = report_file.load(path)
        self.assertEqual(report_file.contradictions(after), report_file.contradictions(sample_report.sample(sound=True)))
        self.assertEqual(len(list(report_file.rows(after))), results + 1)
        self.assertEqual(sorted(c["id"] for c in after["cases"]), [c["id"] for c in after["cases"]])

    def test_the_cases_of_the_repository_ask_what_experiments_find(self):
        sources = "".join(path.read_text() for path in (ROOT / "examples").rglob("*.[ch]pp"))
        for one in laboratory.read_cases():
            for trial in one["dims"].values():
                for run in trial["runs"].values():
                    self.assertTrue((ROOT / "examples" / f"{run['experiment']}.cpp").exists(), run)
                for check in trial["checks"]:
                    words = re.sub(r"^\dd (with friction|without): | of sample \d$", "", check["finding"])
                    self.assertIn(f'"{words}', sources, one["id"])

    def test_filters_and_words(self):
        def said(*arguments):
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = laboratory.main(list(arguments))
            return code, out.getvalue(), err.getvalue()
        self.assertEqual(said("--list", "--filter", "G14", "--dim", "3")[1].count("\n"), 1)
        self.assertEqual(said("--experiments", "--filter", "isostat")[1], "compression\n")
        self.assertEqual(said("--experiments", "--filter", "A01")[1], "\n")
        for arguments, words in ((["--seeds", "0", "x"], "--seeds is 0, but must be at least 1"), ([], "no report is given"),
                                 (["--filter", "("], "unterminated"), ([str(self.folder / "none")], "cannot be read")):
            code, _, err = said(*arguments)
            self.assertEqual(code, 2)
            self.assertIn(words, err)


if __name__ == "__main__":
    unittest.main()
