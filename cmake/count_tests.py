#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Prints "N passed, N failed" from a JUnit file of ctest.

A Boost.Test program that reports its cases (BOOST_TEST_REPORT_LEVEL=short) counts as its cases, any
other test, and a program that died before its report, counts as one. A failed program has at least
one failure, and so has a test that was to run and did not, unless it says itself that it skips.
Exit status 1 when something failed or nothing ran.
"""
import re
import sys
import xml.etree.ElementTree as xml


def cases(output, word):
    found = re.search(r"^\s*(\d+) test cases? out of \d+ " + word, output, re.MULTILINE)
    return int(found.group(1)) if found else 0


def skips(test):
    """Whether its program ran and said so (SKIP_RETURN_CODE); a missing program or fixture does not."""
    skipped = test.find("skipped")
    return skipped is not None and skipped.get("message", "").startswith("SKIP_")


def count(path):
    passed = failed = 0
    for test in xml.parse(path).getroot().iter("testcase"):
        output = test.findtext("system-out") or ""
        if test.get("status") == "run":
            passed += max(1, cases(output, "passed"))
        elif test.get("status") == "fail":
            passed += cases(output, "passed")
            failed += max(1, cases(output, "failed") + cases(output, "aborted"))
        elif test.get("status") == "notrun" and not skips(test):
            failed += 1
    return passed, failed


if __name__ == "__main__":
    passed, failed = count(sys.argv[1])
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed or not passed else 0)
