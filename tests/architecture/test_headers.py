# SPDX-License-Identifier: BSL-1.0
"""headers.py accepts headers that compile alone and names those that do not, with and without Eigen precompiled."""
import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import headers  # noqa: E402

COMPILER, *FLAGS = sys.argv[1:]


def verdict(files):
    """Exit code and output for an include folder of these files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (pathlib.Path(folder) / name).write_text("#pragma once\n" + text)
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            code = headers.main(COMPILER, folder, "2", "all", *FLAGS)
        return code, output.getvalue()


class Headers(unittest.TestCase):
    def test_headers_that_include_what_they_use_pass(self):
        code, text = verdict({
            "plain.hpp": "#include <vector>\ninline std::vector<int> v;\n",
            "eigen.hpp": "#include <Eigen/Core>\ninline Eigen::Vector3d e;\n",
            "through.hpp": "#include <eigen.hpp>\ninline Eigen::Vector3d t = e;\n"})
        self.assertEqual((code, text), (0, "3 of 3 headers compile alone\n"))

    def test_a_missing_include_is_named(self):
        code, text = verdict({"good.hpp": "", "bad.hpp": "inline std::vector<int> v;\n"})
        self.assertEqual(code, 1)
        self.assertIn("bad.hpp does not compile alone", text)
        self.assertIn("1 of 2 headers", text)

    def test_eigen_is_not_lent_to_a_header_that_does_not_lead_to_it(self):
        code, text = verdict({"bad.hpp": "inline Eigen::Vector3d e;\n"})
        self.assertEqual(code, 1)
        self.assertIn("bad.hpp", text)

    def test_warnings_are_errors(self):
        self.assertEqual(verdict({"bad.hpp": "#include <Eigen/Core>\ninline int f(double x) { return x; }\n"})[0], 1)

    def test_changed_headers_and_those_that_include_them(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder) / "include"
            root.mkdir()

            def changed():
                names = sorted(path.name for path in root.glob("*.hpp"))
                return headers.changed(root, names)

            def git(*words):
                subprocess.run(["git", "-C", folder, "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True,
                               capture_output=True)

            def write(name, text=""):
                (root / name).write_text("#pragma once\n" + text)

            write("base.hpp")
            write("user.hpp", "#include <base.hpp>\n")
            write("other.hpp")
            self.assertIsNone(changed())
            git("init")
            git("add", ".")
            git("commit", "-m", "all")
            self.assertIsNone(changed())
            write("base.hpp", "// changed\n")
            git("commit", "-am", "base")
            self.assertEqual(changed(), ["base.hpp", "user.hpp"])
            git("commit", "--allow-empty", "-m", "nothing")
            self.assertEqual(changed(), [])
            write("other.hpp", "// not committed\n")
            write("new.hpp")
            self.assertEqual(changed(), ["new.hpp", "other.hpp"])

    def test_no_header_is_no_success(self):
        self.assertEqual(verdict({})[0], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
