# SPDX-License-Identifier: BSL-1.0
"""make_tables.py: TABLE.md and the generated part of README.md say what the report says."""
import copy
import math
import pathlib
import re
import tempfile
import unittest

import scripts
import make_tables
from sample_report import sample

README = f"before\n{make_tables.BEGIN}\nold\n{make_tables.END}\nafter\n"
REPORT = sample()


def tables_of(report, *more, readme=README):
    """(TABLE.md, README.md, run) of a root made for the purpose; more: a second file with the matrix."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "validation").mkdir()
        scripts.write(root / "README.md", readme)
        path = scripts.write(root / "report.json", report)
        extra = ["--mutants", scripts.write(root / "mutants.json", more[0])] if more else []
        run = scripts.run("make_tables.py", path, "--root", root, *extra)
        target = root / "validation" / "TABLE.md"
        return target.read_text() if target.exists() else None, (root / "README.md").read_text(), run


def cells(line):
    """Cells of a line of a Markdown table; an escaped bar belongs to its cell."""
    return [one.strip() for one in re.split(r"(?<!\\)\|", line)[1:-1]]


def lines_below(text, first):
    """Rows of the table whose first heading is `first`."""
    lines = iter(text.splitlines())
    for line in lines:
        if line.startswith(f"| {first} |"):
            width = len(cells(line))
            next(lines)
            rows = []
            for row in lines:
                if not row.startswith("|"):
                    break
                rows.append(cells(row))
                assert len(rows[-1]) == width, row
            return rows
    raise AssertionError(f"no table {first}")


class Table(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table, cls.readme, run = tables_of(REPORT)
        assert run.returncode == 0, run.stderr

    def test_one_row_per_case_and_dimension(self):
        rows = lines_below(self.table, "case")
        results = [(case, one) for case in REPORT["cases"] for one in case["results"] or [None]]
        self.assertEqual(len(rows), len(results))
        for row, (case, one) in zip(rows, results):
            self.assertEqual(row[0], f"[{case['id']}]({case['file'].removeprefix('validation/')})")
            self.assertEqual(row[2], f"{one['dim']}D" if one else "–")
            self.assertEqual(row[3], case["class"])
            self.assertEqual(row[6].strip("*"), one["verdict"] if one else "not run")
            self.assertEqual(row[6].startswith("**"), not one or one["verdict"] != "passed")
            ratios = [math.inf if c["error"] is None or c["bound"] is None else abs(c["error"]) / c["bound"] if c["bound"]
                      else math.inf if c["error"] else 0.0 for c in one["checks"]] if one else []
            if not ratios:
                self.assertEqual(row[4], "–")
            elif math.isinf(max(ratios)):
                self.assertEqual(row[4], "∞")
            else:
                self.assertLessEqual(abs(float(row[4]) - max(ratios)), 0.051 * max(ratios))

    def test_orders(self):
        rows = lines_below(self.table, "case")
        self.assertRegex(rows[0][5], r"^1\.0\d\d in \[0\.9, 1\.1\]$")
        self.assertRegex(rows[2][5], r"^\*\*0\.6\d\d not in \[0\.9, 1\.1\]\*\*$")
        self.assertEqual(rows[6][5], "**none not in [1.9, 2.1]**")
        self.assertEqual(rows[8][5], "–")

    def test_a_title_cannot_leave_its_cell_nor_become_markup(self):
        title = next(row[1] for row in lines_below(self.table, "case") if "script" in row[1])
        self.assertNotIn("<", title)
        self.assertIn("&lt;/script&gt;", title)
        self.assertIn(r"\`ticks\`", title)

    def test_how_it_was_made(self):
        made = dict(row for row in lines_below(self.table, "of the run"))
        self.assertEqual(made["date"], "2026-11-22T20:30:00Z")
        self.assertEqual(made["commit"], "abc1234")
        self.assertEqual(made["compiler"], "g++ 12.2.0")
        self.assertEqual(made["command"], "validation/run --gate 2")

    def test_faults(self):
        rows = {row[0].replace("\\", ""): row for row in lines_below(self.table, "fault")}
        self.assertEqual(list(rows), [fault["name"] for fault in REPORT["mutants"]["faults"]])
        for name, row in rows.items():
            caught = {cell["case"] for cell in REPORT["mutants"]["cells"]
                      if cell["fault"] == name and cell["outcome"] == "caught"}
            self.assertEqual(int(row[2]), len(caught))
            self.assertEqual(set(re.findall(r"[A-G]\d\d", row[3])), caught)
        self.assertEqual(rows["residual_ignored"][3], "**nobody**")
        self.assertIn("10 faults, 1 caught by nobody; cases that catch nothing: A02.", self.table)

    def test_the_matrix_may_come_from_another_run(self):
        report = copy.deepcopy(REPORT)
        report["mutants"] = None
        without, _, _ = tables_of(report)
        self.assertNotIn("Faults", without)
        for other in (REPORT, REPORT["mutants"]):
            self.assertEqual(tables_of(report, other)[0], self.table)

    def test_the_same_report_gives_the_same_bytes(self):
        self.assertEqual(tables_of(REPORT)[:2], (self.table, self.readme))
        slower = copy.deepcopy(REPORT)
        slower["summary"]["seconds"] *= 2
        for case in slower["cases"]:
            for one in case["results"]:
                one["seconds"] *= 2
        self.assertEqual(tables_of(slower)[:2], (self.table, self.readme))


class Readme(unittest.TestCase):
    def test_short_table_by_section(self):
        _, readme, _ = tables_of(REPORT)
        rows = lines_below(readme, "section")
        self.assertEqual([row[0][0] for row in rows], ["A", "B", "C", "D", "E"])
        for row in rows:
            cases = [case for case in REPORT["cases"] if case["section"] == row[0][0]]
            results = [one for case in cases for one in case["results"]]
            self.assertEqual(int(row[1]), len(cases))
            self.assertEqual(sum(map(int, re.findall(r"(\d+) in", row[2]))), len(results))
            self.assertEqual(int(row[3]), sum(len(one["checks"]) for one in results))
            orders = [order for one in results for order in one["orders"]]
            self.assertEqual(row[5], f"{sum(o['passed'] for o in orders)} of {len(orders)} in their bands")
            passed = sum(one["verdict"] == "passed" for one in results)
            self.assertEqual(row[6].strip("*"), f"{passed} of {len(results)} passed")
            self.assertEqual(row[6].startswith("**"), passed < len(results))

    def test_only_the_generated_part_changes(self):
        _, readme, _ = tables_of(REPORT)
        self.assertTrue(readme.startswith(f"before\n{make_tables.BEGIN}\n"))
        self.assertTrue(readme.endswith(f"\n{make_tables.END}\nafter\n"))
        self.assertNotIn("\nold\n", readme)
        again = tables_of(REPORT, readme=readme)[1]
        self.assertEqual(again, readme)

    def test_without_the_marks_nothing_is_written(self):
        for text in ("no marks", make_tables.BEGIN, f"{make_tables.END} {make_tables.BEGIN}", README * 2):
            table, readme, run = tables_of(REPORT, readme=text)
            self.assertEqual((table, readme, run.returncode), (None, text, 2))
            self.assertIn("README.md must hold", run.stderr)


if __name__ == "__main__":
    unittest.main()
