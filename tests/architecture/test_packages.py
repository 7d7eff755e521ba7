# SPDX-License-Identifier: BSL-1.0
"""usage: test_packages.py ROOT    the groups of packages that commands ask for exist, and are no larger than they should be"""
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop())
COMMANDS = ("examples/run", "tests/run", "bench/run", "validation/run", ".ci/run")


def bash(script, *arguments):
    return subprocess.run(["bash", "-c", f'set -euo pipefail; source "$0"/cmake/setup.sh; {script}', str(ROOT), *arguments],
                          capture_output=True, text=True)


def packages(*groups):
    run = bash('packages_of "$@"', *groups)
    if run.returncode:
        raise LookupError(run.stderr)
    return set(run.stdout.split())


def groups(command, options=""):
    """What a command asks for: ${option:+group} counts where the option is given."""
    asked = [line for line in re.findall(r"\bensure_packages\b(.*)", (ROOT / command).read_text())]
    assert len(asked) == 1, f"{command} asks {len(asked)} times"
    return re.sub(r"\$\{(\w+):\+([^}]*)\}", lambda found: found[2] if found[1] in options.split() else "", asked[0]).split()


class Packages(unittest.TestCase):
    def test_every_group_that_a_command_names_exists(self):
        for command in COMMANDS:
            with self.subTest(command=command):
                named = groups(command, "clang")
                self.assertTrue(named)
                self.assertTrue(packages(*named))

    def test_an_unknown_group_is_refused_before_anything_is_installed(self):
        with self.assertRaisesRegex(LookupError, "no such group of packages: nothing"):
            packages("library", "nothing")
        run = bash("ensure_packages library nothing; echo went on")
        self.assertNotEqual(run.returncode, 0)
        self.assertNotIn("went on", run.stdout)

    def test_an_example_needs_neither_browser_nor_clang(self):
        for name in packages(*groups("examples/run")):
            self.assertNotRegex(name, "chrom|clang|boost|benchmark|gsl|python")

    def test_clang_comes_with_its_option_only(self):
        self.assertNotIn("clang", packages(*groups("tests/run")))
        self.assertIn("clang", packages(*groups("tests/run", "clang")))

    def test_the_checks_of_a_change_get_everything(self):
        everything = packages(*groups(".ci/run"))
        for command in COMMANDS:
            self.assertLessEqual(packages(*groups(command, "clang")), everything)


if __name__ == "__main__":
    unittest.main()
