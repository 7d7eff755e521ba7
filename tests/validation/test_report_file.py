# SPDX-License-Identifier: BSL-1.0
"""report_file.py refuses what is not a report, computes what it says, and notices contradictions."""
import copy
import math
import pathlib
import tempfile
import unittest

import scripts
import report_file
from sample_report import check, sample

SOUND = sample(sound=True)


def result(report, case=0, number=0):
    return report["cases"][case]["results"][number]


class Loading(unittest.TestCase):
    def refused(self, content, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = scripts.write(pathlib.Path(folder) / "report.json", content)
            with self.assertRaises(report_file.ReportError) as caught:
                report_file.load(path)
            # The scripts say the same in one sentence and end with status 2.
            run = scripts.run("make_report.py", path, pathlib.Path(folder) / "out.html")
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
            self.assertFalse((pathlib.Path(folder) / "out.html").exists())
        for word in words:
            self.assertIn(word, str(caught.exception))
            self.assertIn(word, run.stderr)

    def test_a_report_is_accepted(self):
        with tempfile.TemporaryDirectory() as folder:
            path = scripts.write(pathlib.Path(folder) / "report.json", sample())
            self.assertEqual(report_file.load(path), sample())

    def test_other_files_are_refused(self):
        self.refused("{", "is not JSON")
        self.refused("[]", "schema 1")
        self.refused({"schema": 2}, "schema 1")
        self.refused('{"schema": 1, "talus": NaN}', "NaN")

    def test_a_missing_or_wrong_item_is_named(self):
        report = copy.deepcopy(SOUND)
        del result(report, 3)["checks"][2]["bound"]
        self.refused(report, "report.cases[3].results[0].checks[2]", "'bound'")
        report = copy.deepcopy(SOUND)
        result(report)["seconds"] = "fast"
        self.refused(report, "report.cases[0].results[0].seconds", "'fast'")
        report = copy.deepcopy(SOUND)
        report["cases"][0]["gate"] = True
        self.refused(report, "cases[0].gate")
        report = copy.deepcopy(SOUND)
        result(report)["verdict"] = "splendid"
        self.refused(report, "splendid")


class Numbers(unittest.TestCase):
    def test_error_over_bound(self):
        self.assertEqual(report_file.ratio(check("", "R", 0, 0, -0.5, 2.0)), 0.25)
        self.assertEqual(report_file.ratio(check("", "R", 0, 0, 0.0, 0.0)), 0.0)
        for error, bound in ((1e-300, 0.0), (None, 1.0), (0.0, None)):
            self.assertEqual(report_file.ratio(check("", "R", 0, 0, error, bound)), math.inf)

    def test_worst_of_a_result(self):
        one = {"checks": [check("", "R", 0, 0, e, 1.0) for e in (0.1, -0.7, 0.2)],
               "orders": [{"band": [0.9, 1.1], "slope": slope} for slope in (1.02, 0.93, 1.06)]}
        self.assertEqual(report_file.worst_ratio(one), 0.7)
        self.assertEqual(report_file.worst_order(one)["slope"], 0.93)
        self.assertIsNone(report_file.worst_ratio({"checks": []}))
        self.assertIsNone(report_file.worst_order({"orders": []}))
        self.assertEqual(report_file.off_centre({"band": [1, 3], "slope": None}), math.inf)


class Contradictions(unittest.TestCase):
    def found(self, change):
        report = copy.deepcopy(SOUND)
        change(report)
        return " | ".join(report_file.contradictions(report))

    def test_none_in_a_sound_report(self):
        self.assertEqual(report_file.contradictions(SOUND), [])
        self.assertEqual(report_file.contradictions(sample()), [])

    def test_check_called_passed_over_its_bound(self):
        self.assertIn("is called passed, but error / bound = 2", self.found(
            lambda r: result(r)["checks"][0].update(error=2.0, bound=1.0)))

    def test_check_called_passed_without_a_number(self):
        self.assertIn("is called passed", self.found(lambda r: result(r)["checks"][0].update(error=None)))

    def test_order_called_passed_outside_its_band(self):
        def change(report):
            one = next(one for _, one in report_file.rows(report) if one["orders"])
            one["orders"][0]["slope"] = 0.5
        self.assertIn("outside its band", self.found(change))

    def test_verdict_against_its_checks(self):
        def fail(report):
            result(report)["checks"][0].update(error=2.0, bound=1.0, passed=False)
        self.assertIn("is called passed, but not everything in it passed", self.found(fail))
        self.assertIn("is called failed, but everything in it passed",
                      self.found(lambda r: result(r).update(verdict="failed")))
        self.assertIn("not everything", self.found(lambda r: result(r).update(error="thrown")))

    def test_passed_without_a_check(self):
        self.assertIn("without a check", self.found(lambda r: result(r).update(checks=[], orders=[])))

    def test_summary(self):
        for key in ("cases", "results", "passed", "failed", "checks"):
            self.assertIn(f"the summary counts {SOUND['summary'][key] + 1} {key}",
                          self.found(lambda r, key=key: r["summary"].update({key: r["summary"][key] + 1})))

    def test_result_twice_or_in_a_foreign_dimension(self):
        self.assertIn("is there twice", self.found(lambda r: r["cases"][0]["results"].append(copy.deepcopy(result(r)))))
        self.assertIn("not among the dimensions", self.found(lambda r: r["cases"][0].update(dims=[7])))

    def test_they_are_said_and_end_with_status_1(self):
        report = copy.deepcopy(SOUND)
        report["summary"]["passed"] += 1
        with tempfile.TemporaryDirectory() as folder:
            path = scripts.write(pathlib.Path(folder) / "report.json", report)
            for script, out in (("make_report.py", "o.html"), ("make_junit.py", "o.xml")):
                run = scripts.run(script, path, pathlib.Path(folder) / out)
                self.assertEqual(run.returncode, 1)
                self.assertIn("the report contradicts itself: the summary counts", run.stderr)
                self.assertTrue((pathlib.Path(folder) / out).exists())


class Mutants(unittest.TestCase):
    def test_findings(self):
        def cell(case, fault, claimed, outcome):
            return {"case": case, "dim": 2, "fault": fault, "claimed": claimed, "outcome": outcome, "by": ""}
        mutants = {"faults": [{"name": name, "title": name} for name in ("x", "y", "z")],
                   "cells": [cell("A01", "x", True, "caught"), cell("A01", "y", True, "survived"),
                             cell("A02", "x", False, "survived"), cell("A02", "z", True, "not run")]}
        findings = report_file.mutant_findings(mutants)
        self.assertEqual(findings["survivors"], ["y", "z"])
        self.assertEqual(findings["idle"], ["A02"])
        self.assertEqual(findings["broken"], [mutants["cells"][1]])
        self.assertEqual(findings["untried"], [mutants["cells"][3]])


if __name__ == "__main__":
    unittest.main()
