# SPDX-License-Identifier: BSL-1.0
"""make_junit.py: a suite per section, a test per case and dimension, failures that say what failed."""
import collections
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as xml

import scripts
from sample_report import HOSTILE, sample

REPORT = sample()
REPORT["environment"]["bell"] = "\a\x00"  # what XML cannot hold


def convert(report):
    with tempfile.TemporaryDirectory() as folder:
        path = scripts.write(pathlib.Path(folder) / "report.json", report)
        out = pathlib.Path(folder) / "junit.xml"
        run = scripts.run("make_junit.py", path, out)
        assert run.returncode == 0, run.stderr
        return xml.parse(out).getroot()


class Junit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = convert(REPORT)

    def test_one_suite_per_section(self):
        sections = sorted({case["section"] for case in REPORT["cases"]})
        self.assertEqual([suite.get("name").split()[0] for suite in self.root], sections)

    def test_one_test_per_case_and_dimension(self):
        expected = [f"{case['id']} {case['name']}" + (f" {one['dim']}D" if one else "")
                    for case in REPORT["cases"] for one in case["results"] or [None]]
        self.assertEqual([test.get("name") for test in self.root.iter("testcase")], expected)
        self.assertEqual(len(set(expected)), len(expected))

    def test_verdicts(self):
        tags = {"passed": [], "failed": ["failure"], "error": ["error"]}
        results = [one for case in REPORT["cases"] for one in case["results"] or [None]]
        for test, one in zip(self.root.iter("testcase"), results, strict=True):
            self.assertEqual([child.tag for child in test], tags[one["verdict"]] if one else ["skipped"], test.get("name"))
            self.assertAlmostEqual(float(test.get("time")), one["seconds"] if one else 0, places=3)

    def test_counts_are_those_of_the_tests(self):
        whole = collections.Counter()
        for suite in self.root:
            tests = suite.findall("testcase")
            counts = {"tests": len(tests), **{key: sum(test.find(tag) is not None for test in tests) for key, tag in
                                              (("failures", "failure"), ("errors", "error"), ("skipped", "skipped"))}}
            self.assertEqual({key: int(suite.get(key)) for key in counts}, counts)
            whole.update(counts)
        self.assertEqual({key: int(self.root.get(key)) for key in whole}, dict(whole))
        self.assertGreater(min(whole.values()), 0)  # the invented report has some of each

    def test_failure_lists_the_failed_checks_and_no_other(self):
        case = REPORT["cases"][1]
        failure = self.root.find(f".//testcase[@name='{case['id']} {case['name']} 2D']/failure")
        lines = failure.text.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(lines[0], "check 'velocity at 1 s' [R] at h = 0.01: measured 1.25 m/s, expected 1 m/s: "
                                   "error 0.25, bound 1e-12 (a real fault)")
        self.assertEqual(lines[1], "check 'statuses agree in every step' [S]: error 1, bound 0 (slides in step 3)")
        self.assertIn("barely outside", lines[2])
        self.assertRegex(lines[3], r"^order of 'position': 0\.6\d* is not in \[0\.9, 1\.1\]$")
        self.assertTrue(failure.get("message").startswith("4 failures, first: check 'velocity at 1 s'"))

    def test_missing_numbers_are_called_so(self):
        case = REPORT["cases"][3]
        text = self.root.find(f".//testcase[@name='{case['id']} {case['name']} 2D']/failure").text
        self.assertIn("measured not finite, expected 1: error not finite, bound 1e-12", text)
        self.assertIn("order of 'position': not finite", text)

    def test_an_exception_is_an_error_with_its_text(self):
        error = self.root.find(".//testcase/error")
        self.assertTrue(error.text.startswith("the assembly refused a mass of -1 kg\n"))
        self.assertIn(HOSTILE, error.text)

    def test_environment(self):
        for suite in self.root:
            found = {one.get("name"): one.get("value") for one in suite.find("properties")}
            self.assertEqual(found["compiler"], "g++ 12.2.0")
            self.assertEqual(found["cores"], "2")
            self.assertEqual(found["bell"], "\ufffd\ufffd")

    def test_a_sound_report_has_neither_failure_nor_error(self):
        root = convert(sample(sound=True))
        self.assertEqual([root.get(key) for key in ("failures", "errors", "skipped")], ["0", "0", "0"])
        self.assertEqual([test for test in root.iter("testcase") if len(test)], [])


if __name__ == "__main__":
    unittest.main()
