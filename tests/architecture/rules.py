# SPDX-License-Identifier: BSL-1.0
"""usage: rules.py ROOT    checks the sources below ROOT and names file, line and offence.

The layering rule: a header includes its own room and what is listed for it, nothing else. A room is
a folder of include/talus, or a folder within one; a list names rooms, or single headers of a room.
"""
import pathlib
import re
import sys

PHYSICS = {"core", "spatial", "geometry", "geometry/hull", "collision", "dynamics"}
ALGEBRA = {"core", "law", "problem", "linear", "solver", "solver/sweeps", "solver/cones", "solver/oracle"}
# What the rooms of `solver` may know of its top: what a solver is, and what it reports.
SOLVER = {"core", "law", "problem", "solver/concepts", "solver/report"}
LAYERS = {
    "core/matrix": {"core/small_matrix"},
    "core": {"core/matrix"},
    "spatial": {"core"},
    "law": {"core"},
    "problem": {"core", "law"},
    "geometry/hull": {"core"},
    "geometry": {"core", "spatial", "geometry/hull"},
    "dynamics": {"core", "spatial"},
    "linear": {"core"},
    "solver/sweeps": SOLVER,
    "solver/cones": SOLVER | {"linear", "solver/sweeps"},
    "solver/oracle": SOLVER | {"linear", "solver/cones"},
    "solver": ALGEBRA,
    "collision": {"core", "spatial", "geometry"},
    "assembly": {"core", "spatial", "collision", "dynamics", "law", "problem"},
    "stepping": PHYSICS | ALGEBRA | {"assembly"},
    "lagrangian": {"core", "law", "problem", "solver/concepts", "solver/report", "solver/sweeps", "stepping/step_hooks"},
    "lagrangian/event_driven": {"core", "law", "problem", "solver/concepts", "solver/report", "solver/sweeps", "lagrangian"},
    "feed": PHYSICS | {"law", "sample", "stepping/system"},
    "sample": {"core", "spatial", "geometry", "geometry/hull", "collision/gjk", "dynamics"},
    "measure": PHYSICS | {"law", "problem"},
    "io/mesh": {"core", "io/line_reader"},
    "io/series": {"core", "spatial", "geometry", "dynamics", "io/vtk", "io/write_file"},
    "io/checkpoint": {"core", "spatial", "dynamics", "io/hdf5_reader", "io/hdf5_writer"},
    "io/sample": {"core", "sample", "io/line_reader"},
    "io": PHYSICS | {"law", "problem", "assembly", "sample", "measure"},
}
LONGEST_HEADER = 400
MOST_HEADERS = 18
KNOWS_DIMENSION = {"core", "spatial", "geometry", "collision"}
KNOWS_STEP_SIZE = {"assembly/free_velocity.hpp", "stepping"}
MAY_WRITE = {"io"}
MAY_FORMAT = {"core/input.hpp"}

DIMENSION_BRANCH = [
    (re.compile(r"\bDim\s*(?:[=!]=|[<>]=?)\s*\d"), "comparison of Dim"),
    (re.compile(r"\bDimensionTag\s*<"), "dispatch on DimensionTag"),
    (re.compile(r"template\s*<\s*>[^;{(]*?<\s*[23]\b"), "specialisation for one dimension"),
]
STEP_SIZE = re.compile(r"\b(?:double|Real|float)\s+h\s*[,)]")
FORMATTING = re.compile(r"#include <cstdio>|\bsnprintf\s*\(")
OUTPUT = re.compile(
    r"#include <(?:iostream|ostream|istream|fstream|sstream|cstdio|stdio\.h|filesystem)>"
    r"|\b(?:std::)?(?:v?(?:f|s|sn)?printf|puts|fputs|fopen|fwrite)\s*\("
    r"|\bstd::(?:cout|cerr|clog|[io]?fstream|[io]?stringstream|[io]stream|filesystem)\b")
REFERENCE = re.compile(r"\[([A-Z][A-Za-z]+\d{4}[a-z]?)(?:,[^\]]*)?\]")
UNFINISHED = re.compile(r"\b(?:TODO|FIXME|XXX|HACK)\b")
# One word per thing: the banned synonym and the word to use.
VOCABULARY = {
    r"\bdt\b|\btime_?step\b|\bstep_size\b": "h",
    r"\bpenetration_depth\b": "gap",
    r"\bpercussions?\b|\breactions?\b": "impulse (or mean_reaction for r / h)",
    r"\bfriction_coeff?\w*\b": "mu",
    r"\brestitution_coeff?\w*\b|\bcoeff?_of_restitution\b": "restitution",
    r"\btangent_basis\b|\bcontact_basis\b": "LocalFrame",
    r"\bnum_\w+|\bnb_\w+": "..._count",
    r"\bmin_?max_?utils?\b|\butils?\b": "a name that says what it does",
    r"\bbroadphase\b": "broad_phase, or the name of the method",
    r"\bconstraint_graph\b": "contact_graph",
}


def without_comments(text):
    """The code of `text`, comments and strings blanked, line numbers kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", blank, text, flags=re.DOTALL)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


class Tree:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.include = self.root / "include" / "talus"
        self.violations = []

    def report(self, path, line, what):
        self.violations.append(f"{path.relative_to(self.root)}:{line}: {what}")

    def report_all(self, path, text, pattern, what):
        for match in pattern.finditer(text):
            self.report(path, line_of(text, match.start()), f"{what}: '{match.group().strip()}'")

    def check(self):
        bib = self.include / "references.bib"
        self.keys = set(re.findall(r"@\w+\s*\{\s*([^,\s]+)\s*,", bib.read_text())) if bib.exists() else set()
        for folder in sorted(p for p in self.include.rglob("*") if p.is_dir()):
            if folder.relative_to(self.include).as_posix() not in LAYERS:
                self.report(folder, 0, "folder unknown to the layering table")
            if not (folder / "README.md").exists():
                self.report(folder, 0, "folder without README.md")
            headers = sorted(folder.glob("*.hpp"))
            if len(headers) > MOST_HEADERS:
                self.report(folder, 0, f"{len(headers)} headers in one room, more than {MOST_HEADERS}")
            page = folder / "README.md"
            words = set(re.findall(r"\w+", page.read_text())) if page.exists() else set()
            for header in headers:
                if page.exists() and header.stem not in words:
                    self.report(header, 0, "not named on the folder's page")
        for path in sorted(self.include.rglob("*.hpp")):
            self.check_header(path)
        for part in ("include", "tests", "examples", "bench", "validation"):
            for path in sorted((self.root / part).rglob("*.[ch]pp")):
                self.check_source(path)
        for page in sorted((self.root / "tests").glob("*/CMakeLists.txt")):
            self.check_tests(page)
        return self.violations

    def check_tests(self, page):
        """A file of tests that its folder's list leaves out is never run."""
        text = page.read_text()
        if re.search(r"GLOB[^)]*\btest_\*\.cpp", text):
            return
        for path in sorted(page.parent.glob("test_*.cpp")):
            if not re.search(r"\b%s\b" % re.escape(path.stem), text):
                self.report(path, 0, "a file of tests that CMakeLists.txt does not name")

    def check_source(self, path):
        text = path.read_text()
        if not text.startswith("// SPDX-License-Identifier: BSL-1.0\n"):
            self.report(path, 1, "first line is not the SPDX line of BSL-1.0")
        self.report_all(path, text, UNFINISHED, "unfinished")

    def check_header(self, path):
        text, relative = path.read_text(), path.relative_to(self.include)
        name = relative.as_posix()
        room = "" if relative.parent == pathlib.PurePath() else relative.parent.as_posix()
        folder = room.split("/")[0]
        lines = text.splitlines()
        if len(lines) > LONGEST_HEADER:
            self.report(path, len(lines), f"header longer than {LONGEST_HEADER} lines")
        if lines[1:2] != ["#pragma once"]:
            self.report(path, 2, "second line is not '#pragma once'")
        self.check_includes(path, text, room)
        code = without_comments(text)
        if folder not in KNOWS_DIMENSION:
            for pattern, what in DIMENSION_BRANCH:
                self.report_all(path, code, pattern, what)
        if not {folder, name} & KNOWS_STEP_SIZE:
            self.report_all(path, code, STEP_SIZE, "the step size is a parameter")
        if folder not in MAY_WRITE:
            seen = FORMATTING.sub("", code) if name in MAY_FORMAT else code
            self.report_all(path, seen, OUTPUT, "stream, file or print outside io")
        for synonym, word in VOCABULARY.items():
            self.report_all(path, code, re.compile(synonym), f"the word to use is {word}")
        for match in REFERENCE.finditer(text):
            if match.group(1) not in self.keys:
                self.report(path, line_of(text, match.start()), f"{match.group(1)} is not in references.bib")

    def check_includes(self, path, text, room):
        allowed = LAYERS.get(room, set()) | {room}
        for match in re.finditer(r'^#\s*include\s*([<"])([^>"]+)[>"]', text, re.MULTILINE):
            line, target = line_of(text, match.start()), match.group(2)
            if match.group(1) == '"':
                self.report(path, line, f'include written with quotes: "{target}"')
            elif target.startswith("talus/") and room:
                header = target.removeprefix("talus/").removesuffix(".hpp")
                other = header.rpartition("/")[0] or target.removeprefix("talus/")
                if other not in allowed and header not in allowed:
                    self.report(path, line, f"layering: {room} -> {other}")


if __name__ == "__main__":
    found = Tree(sys.argv[1]).check()
    print("\n".join(found) if found else "all rules hold")
    sys.exit(1 if found else 0)
