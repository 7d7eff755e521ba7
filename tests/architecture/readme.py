# SPDX-License-Identifier: BSL-1.0
"""usage: readme.py ROOT    checks README.md of ROOT: code is that of the examples, links lead somewhere."""
import pathlib
import re
import sys


def faults(root):
    text = (root / "README.md").read_text()
    for match in re.finditer(r"(?:<!-- from (\S+) -->\n)?```cpp\n(.*?)```", text, re.DOTALL):
        source, code = match.groups()
        if source is None:
            yield "README.md: a block of C++ that does not say which example it is from"
        elif code not in (root / source).read_text():
            yield f"README.md: code that is not in {source}"
    prose = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    for target in re.findall(r"\]\(([^)#]+)\)", prose):
        if not target.startswith("http") and not (root / target).exists():
            yield f"README.md: link to {target}, which is not there"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "README.md agrees with the examples")
    sys.exit(1 if found else 0)
