# SPDX-License-Identifier: BSL-1.0
"""rules.py is silent on a clean tree and reports each planted violation, with file and line."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import rules  # noqa: E402

HEAD = "// SPDX-License-Identifier: BSL-1.0\n#pragma once\n"


def violations(name, text, head=HEAD, bib="@book{Moreau2000,\n}\n", readme=True, named=True):
    """What the rules say of a tree whose only header is include/talus/`name`."""
    with tempfile.TemporaryDirectory() as root:
        include = pathlib.Path(root) / "include" / "talus"
        path = include / name
        path.parent.mkdir(parents=True)
        path.write_text(head + text)
        if readme:
            for folder in path.relative_to(include).parents[:-1]:
                (include / folder / "README.md").write_text(path.stem if named else "")
        (include / "references.bib").write_text(bib)
        return rules.Tree(root).check()


class Rules(unittest.TestCase):
    def accepts(self, name, text):
        self.assertEqual(violations(name, text), [])

    def rejects(self, name, text, line, word, **options):
        found = violations(name, text, **options)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"include/talus/{name}:{line}: "), found)
        self.assertIn(word, found[0])

    def test_a_clean_header_passes(self):
        self.accepts("law/a.hpp", "#include <talus/core/types.hpp>\n#include <vector>\n/// after [Moreau2000, (9)]\n")

    def test_a_forbidden_include_is_reported(self):
        self.rejects("law/a.hpp", "\n#include <talus/geometry/ball.hpp>\n", 4, "law -> geometry")

    def test_the_columns_do_not_meet_below_assembly(self):
        for low, high in (("solver", "dynamics"), ("collision", "law"), ("problem", "solver"), ("io", "stepping")):
            self.rejects(f"{low}/a.hpp", f"#include <talus/{high}/b.hpp>\n", 3, f"{low} -> {high}")

    def test_rooms_within_a_folder_are_layered(self):
        self.rejects("linear/a.hpp", "#include <talus/law/coulomb.hpp>\n", 3, "linear -> law")
        self.rejects("solver/sweeps/a.hpp", "#include <talus/solver/cones/b.hpp>\n", 3, "sweeps -> solver/cones")
        self.rejects("solver/cones/a.hpp", "#include <talus/solver/automatic.hpp>\n", 3, "cones -> solver")
        self.rejects("assembly/a.hpp", "#include <talus/solver/sweeps/b.hpp>\n", 3, "assembly -> solver/sweeps")
        self.accepts("solver/cones/a.hpp", "#include <talus/solver/report.hpp>\n#include <talus/linear/b.hpp>\n")
        self.accepts("stepping/a.hpp", "#include <talus/solver/sweeps/b.hpp>\n")

    def test_a_file_of_tests_that_no_list_names_is_reported(self):
        for listed, found in (("talus_test(law test_a.cpp)", 1), ("talus_test(law test_a.cpp test_b.cpp)", 0),
                              ("file(GLOB files CONFIGURE_DEPENDS test_*.cpp)", 0)):
            with tempfile.TemporaryDirectory() as root:
                tests = pathlib.Path(root) / "tests" / "law"
                tests.mkdir(parents=True)
                (pathlib.Path(root) / "include" / "talus").mkdir(parents=True)
                (tests / "CMakeLists.txt").write_text(listed)
                for name in ("test_a.cpp", "test_b.cpp"):
                    (tests / name).write_text(HEAD)
                violations = rules.Tree(root).check()
                self.assertEqual(len(violations), found, violations)
                self.assertEqual([v for v in violations if "tests/law/test_b.cpp" not in v], [])

    def test_crowded_rooms_are_reported(self):
        with tempfile.TemporaryDirectory() as root:
            law = pathlib.Path(root) / "include" / "talus" / "law"
            law.mkdir(parents=True)
            (law / "README.md").write_text(" ".join(f"`a{k}`" for k in range(19)))
            for k in range(19):
                (law / f"a{k}.hpp").write_text(HEAD)
            self.assertEqual(rules.Tree(root).check(),
                             ["include/talus/law:0: 19 headers in one room, more than 18"])

    def test_headers_that_their_page_leaves_out_are_reported(self):
        self.rejects("law/a.hpp", "", 0, "page", named=False)

    def test_the_umbrella_is_not_for_headers(self):
        self.rejects("law/a.hpp", "#include <talus/talus.hpp>\n", 3, "law -> talus.hpp")

    def test_quoted_includes_are_reported(self):
        self.rejects("law/a.hpp", '#include "b.hpp"\n', 3, "quotes")

    def test_branching_on_the_dimension_has_its_rooms(self):
        for text in ("if constexpr (Dim == 2) {}", "requires(Dim != 3)", "f(DimensionTag<2>{});",
                     "template <>\nclass A<2> {};", "template <> inline int f<3>() {}"):
            self.rejects("law/a.hpp", text + "\n", 3, "mension" if "Dim " not in text else "Dim")
            self.accepts("geometry/a.hpp", text + "\n")

    def test_instantiating_is_not_branching(self):
        self.accepts("law/a.hpp", "static_assert(ContactLaw<Coulomb<2>, 2>);\ntemplate <int Dim> void f(Vector<Dim> x);\n")

    def test_the_step_size_is_known_to_free_velocity_and_stepping(self):
        self.rejects("solver/a.hpp", "void f(double h);\n", 3, "step size")
        self.accepts("stepping/a.hpp", "void f(double h);\n")
        self.accepts("assembly/free_velocity.hpp", "void f(int n, double h);\n")

    def test_only_io_writes(self):
        for text in ("#include <iostream>", "std::printf(x);", "std::snprintf(b, 3, f);", "auto& o = std::cout;", "#include <fstream>"):
            self.rejects("core/a.hpp", text + "\n", 3, "outside io")
            self.accepts("io/a.hpp", text + "\n")
        self.accepts("core/input.hpp", "#include <cstdio>\nint n = std::snprintf(b, 3, f);\n")

    def test_unknown_references_are_reported(self):
        self.rejects("law/a.hpp", "/// see [Nobody1999]\n", 3, "Nobody1999")

    def test_units_are_not_references(self):
        self.accepts("law/a.hpp", "double m;  ///< [kg]\n")

    def test_house_words_are_used(self):
        self.rejects("law/a.hpp", "double time_step;\n", 3, "is h")
        self.rejects("law/a.hpp", "int num_contacts;\n", 3, "_count")
        self.accepts("law/a.hpp", "double mean_reaction;  // a reaction, in a comment\n")

    def test_unfinished_work_is_reported(self):
        self.rejects("law/a.hpp", "// TO" "DO later\n", 3, "unfinished")

    def test_the_first_lines_are_fixed(self):
        self.rejects("law/a.hpp", "", 1, "SPDX", head="\n#pragma once\n")
        self.rejects("law/a.hpp", "", 2, "pragma", head="// SPDX-License-Identifier: BSL-1.0\n\n")

    def test_long_headers_are_reported(self):
        self.rejects("law/a.hpp", "\n" * 399, 401, "longer")

    def test_every_folder_has_a_readme(self):
        found = violations("law/a.hpp", "", readme=False)
        self.assertEqual(found, ["include/talus/law:0: folder without README.md"])

    def test_unknown_folders_are_reported(self):
        self.assertIn("unknown", violations("misc/a.hpp", "")[0])


if __name__ == "__main__":
    unittest.main()
