# SPDX-License-Identifier: BSL-1.0
"""cmake/count_tests.py counts the cases of Boost.Test programs, other tests and crashes as it says."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(sys.argv.pop()) / "cmake" / "count_tests.py"


NOT_FOUND = '<skipped message="Unable to find executable: /nowhere"/>'
SKIPS = '<skipped message="SKIP_RETURN_CODE=77"/>'


def count(*cases):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "junit.xml"
        path.write_text("<testsuite>" + "".join(
            f'<testcase status="{status}"><system-out>{output}</system-out></testcase>'
            for status, output in cases) + "</testsuite>")
        run = subprocess.run([sys.executable, str(SCRIPT), str(path)], capture_output=True, text=True)
        return run.stdout.strip(), run.returncode


class Counting(unittest.TestCase):
    def test_cases_of_a_program_are_counted_one_by_one(self):
        self.assertEqual(count(("run", "  12 test cases out of 12 passed\n")), ("12 passed, 0 failed", 0))

    def test_a_failed_program_adds_its_passed_and_failed_cases(self):
        text = "  3 test cases out of 5 passed\n  2 test cases out of 5 failed\n"
        self.assertEqual(count(("fail", text)), ("3 passed, 2 failed", 1))

    def test_a_crash_and_a_script_count_as_one(self):
        self.assertEqual(count(("fail", "Segmentation fault"), ("run", "ok")), ("1 passed, 1 failed", 1))

    def test_what_did_not_run_is_a_failure_unless_it_skips(self):
        ran = ("run", "ok")
        self.assertEqual(count(ran, ("notrun", "</system-out>" + NOT_FOUND + "<system-out>")), ("1 passed, 1 failed", 1))
        self.assertEqual(count(ran, ("notrun", "")), ("1 passed, 1 failed", 1))
        self.assertEqual(count(ran, ("notrun", "</system-out>" + SKIPS + "<system-out>")), ("1 passed, 0 failed", 0))

    def test_no_test_at_all_is_a_failure(self):
        self.assertEqual(count(), ("0 passed, 0 failed", 1))


if __name__ == "__main__":
    unittest.main()
