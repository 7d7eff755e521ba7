#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes one HTML file that plays the movie of a run (MovieSeries), from disk and without network.

A movie of space needs three.js, which becomes part of the file: the npm package `three` of the version
that cmake/setup.sh names, there, in a node_modules beside the repository's root, or where --three or
TALUS_THREE says. Exit status: 0, or 2 with one sentence when it cannot be made; OUT.html is then as it was.
"""
import argparse
import array
import base64
import json
import math
import os
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# What player and script were written for; patches differ in nothing that they use.
THREE_VERSION = "0.170."
THREE_PLACES = (ROOT / "build/npm/node_modules/three", ROOT / "node_modules/three", ROOT.parent / "node_modules/three")
THREE_PARTS = {"three": "build/three.module.min.js", "three/orbit": "examples/jsm/controls/OrbitControls.js"}
ROTATION_NUMBERS = {2: 1, 3: 4}


class MovieError(Exception):
    """What is wrong with the input, as one sentence."""


def shown(text):
    """On one line, and nothing that a terminal would obey."""
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" if ord(c) < 256 else "?" for c in str(text))


# ---- the movie -------------------------------------------------------------------------------------

def no_constant(name):
    raise ValueError(f"{name} is no JSON")


def parsed(line):
    """The object of a line; None if it is none."""
    try:
        value = json.loads(line, parse_constant=no_constant)
    except (ValueError, RecursionError):
        return None
    return value if isinstance(value, dict) else None


def header_of(path, line):
    header = parsed(line)
    if header is None or not line.endswith(b"\n"):
        what = "is empty" if not line else "is cut off in its first line, or no movie"
        raise MovieError(f"{path} {what}, but must begin with the line of a talus movie")
    wanted = {"format": ("talus movie",), "version": (1,), "dimension": (2, 3)}
    for name, accepted in wanted.items():
        value = header.get(name)
        if isinstance(value, bool) or value not in accepted:
            raise MovieError(f"{name} of {path} is {json.dumps(value)}, but must be "
                             + " or ".join(json.dumps(one) for one in accepted))
    for name in ("title", "scalar", "unit"):
        if not isinstance(header.get(name), str):
            raise MovieError(f"{name} of {path} is {json.dumps(header.get(name))}, but must be words")
    return header


def numbers(values, count, what, unknown=False):
    """`count` numbers as 32 bit floats; None counts as NaN where a value may be unknown."""
    if not isinstance(values, list) or len(values) != count:
        found = len(values) if isinstance(values, list) else "no"
        raise MovieError(f"has {found} numbers as {what}, but must have {count}")
    try:
        found = array.array("f", [math.nan if unknown and x is None else x for x in values])
    except (TypeError, OverflowError):
        raise MovieError(f"has {what} that are no numbers") from None
    if not unknown and not all(map(math.isfinite, found)):
        raise MovieError(f"has {what} beyond 32 bit floats")
    return found


def check_shape(shape, dimension, depth=0):
    """Raises unless a shape has what the player draws it from."""
    if not isinstance(shape, dict):
        raise MovieError("has no shape")
    fields = {"ball": ("radius", "centre"), "half_space": ("normal", "offset"), "core": ("radius", "vertices", "faces"),
              "compound": ("children",), "box": ("low", "high"), "hole": ("radius", "centre"), "unbounded": ()}
    kind = shape.get("kind")
    if kind not in fields:
        raise MovieError(f"has a shape of kind {json.dumps(kind)}, but known are {', '.join(fields)}")
    for name in fields[kind]:
        value = shape.get(name)
        if name in ("radius", "offset"):
            numbers([value], 1, f"{name} of a {kind}")
        elif name in ("centre", "normal", "low", "high"):
            numbers(value, dimension, f"{name} of a {kind}")
        elif name == "vertices":
            if not isinstance(value, list) or not value or len(value) % dimension:
                raise MovieError("has a core whose vertices are no points")
            numbers(value, len(value), "vertices of a core")
        elif name == "faces":
            count = len(shape["vertices"]) // dimension
            good = isinstance(value, list) and all(
                isinstance(face, list) and len(face) >= 2
                and all(type(v) is int and 0 <= v < count for v in face) for face in value)
            if not good:
                raise MovieError("has a core whose faces are no loops of its vertices")
        elif not isinstance(value, list) or depth:
            raise MovieError("has a compound without children, or one in another")
        else:
            for child in value:
                check_shape(child, dimension, depth + 1)
    if kind == "hole" and dimension == 3:
        numbers(shape.get("axis"), 3, "axis of a hole")


def text_of(numbers_):
    if sys.byteorder == "big":
        numbers_ = array.array(numbers_.typecode, numbers_)
        numbers_.byteswap()
    return base64.b64encode(numbers_.tobytes()).decode("ascii")


class Movie:
    """What the page needs: the header, bodies with shapes, frames as base64 of little-endian numbers."""

    def __init__(self, path):
        self.bodies, self.frames = [], []
        self.place, self.members = {}, None
        with open(path, "rb") as file:
            self.header = header_of(shown(path), file.readline())
            self.dimension = self.header["dimension"]
            for number, line in enumerate(file, 2):
                if not line.endswith(b"\n"):
                    break  # the run was killed within it
                try:
                    self.take(parsed(line))
                except MovieError as problem:
                    raise MovieError(f"line {number} of {shown(path)} {problem}") from None
        if not self.frames:
            raise MovieError(f"{shown(path)} holds no frame, but must hold at least one")

    def take(self, line):
        if line is not None and "body" in line:
            return self.take_body(line)
        if line is not None and "time" in line:
            return self.take_frame(line)
        raise MovieError("is neither that of a body nor a frame")

    def take_body(self, line):
        serial = line["body"]
        if type(serial) is not int or serial < 0 or serial in self.place:
            raise MovieError(f"tells of body {json.dumps(serial)}, but must of one that was not told of")
        check_shape(line.get("shape"), self.dimension)
        self.place[serial] = len(self.bodies)
        self.bodies.append({"id": serial, "obstacle": line.get("obstacle") is True, "shape": line["shape"]})

    def take_frame(self, line):
        time = line["time"]
        if type(time) not in (int, float) or not math.isfinite(time) or (self.frames and not time > self.frames[-1]["time"]):
            raise MovieError(f"has the time {json.dumps(time)}, but must have one later than the frame before")
        serials = line.get("bodies")
        if not isinstance(serials, list) or not all(type(one) is int and one in self.place for one in serials):
            raise MovieError("names bodies whose shapes were not told")
        n = len(serials)
        state = numbers(line.get("positions"), n * self.dimension, "positions")
        state += numbers(line.get("rotations"), n * ROTATION_NUMBERS[self.dimension], "rotations")
        if self.header["scalar"]:
            state += numbers(line.get("scalars"), n, "scalars", unknown=True)
        frame = {"time": time, "state": text_of(state)}
        if serials != self.members:  # else those of the frame before
            frame["members"] = text_of(array.array("I", [self.place[one] for one in serials]))
            self.members = serials
        self.frames.append(frame)

    def content(self):
        return {"movie": self.header, "bodies": self.bodies, "frames": self.frames}


# ---- the page --------------------------------------------------------------------------------------

def embedded(value):
    """JSON that cannot end the script element it stands in, nor open a comment there."""
    text = json.dumps(value, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def three_folder(given):
    """Where three.js is, checked."""
    places = [pathlib.Path(given)] if given else list(THREE_PLACES)
    install = ("install it by: bash -c 'source cmake/setup.sh; ensure_packages player', "
               "or name the folder of the npm package by --three")
    for place in places:
        try:
            version = json.loads((place / "package.json").read_text(encoding="utf-8"))["version"]
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if not str(version).startswith(THREE_VERSION):
            raise MovieError(f"three.js in {shown(place)} is of version {shown(version)}, but must be of {THREE_VERSION}*; {install}")
        return place
    where = f" in {shown(given)}" if given else ""
    raise MovieError(f"a movie of space needs three.js, which is not{where or ' there'}; {install}")


def import_map(folder):
    """The parts of three.js as addresses that hold all their text; the browser gives them these names."""
    def address(name):
        return "data:text/javascript;base64," + base64.b64encode((folder / name).read_bytes()).decode("ascii")
    return embedded({"imports": {name: address(part) for name, part in THREE_PARTS.items()}})


def page(movie, three):
    plane = movie.dimension == 2
    parts = {
        "@TITLE@": "".join(f"&#{ord(c)};" if c in "<>&\"'" else c for c in movie.header["title"] or "talus movie"),
        "@NOTICE@": "" if plane else "<!-- holds three.js, copyright its authors, MIT licence: "
                    "see the notice in the text of its module -->\n",
        "@MOVIE@": embedded(movie.content()),
        "@MODULES@": "" if plane else f'<script type="importmap">{import_map(three_folder(three))}</script>\n',
        "@DRAWING@": (HERE / ("plane.js" if plane else "space.js")).read_text(encoding="utf-8"),
        "@PLAYER@": (HERE / "player.js").read_text(encoding="utf-8"),
    }
    text = (HERE / "player.html").read_text(encoding="utf-8")
    pieces = []
    for mark, part in parts.items():  # in the order of the page, so that no part is searched for marks
        before, text = text.split(mark)
        pieces += [before, part]
    return "".join([*pieces, text])


def replace(path, text):
    """Writes a file whole or not at all."""
    data = text.encode("utf-8", "replace")
    path = pathlib.Path(os.path.realpath(path))
    if path.is_dir():
        raise MovieError(f"{shown(path)} is a folder, but must be a file to write")
    if path.exists() and not path.is_file():
        path.write_bytes(data)  # a device or pipe
        return
    descriptor, name = tempfile.mkstemp(prefix=".talus-", suffix=".part", dir=path.parent)
    try:
        with open(descriptor, "wb") as file:
            file.write(data)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~mask)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("movie", metavar="MOVIE", help="as MovieSeries has written it")
    parser.add_argument("html", metavar="OUT.html")
    parser.add_argument("--three", metavar="FOLDER", default=os.environ.get("TALUS_THREE"),
                        help="the npm package three, for movies of space; default: the variable TALUS_THREE, "
                             "then where cmake/setup.sh puts it")
    options = parser.parse_args()
    try:
        replace(options.html, page(Movie(options.movie), options.three))
    except MovieError as problem:
        sentence = str(problem)
    except OSError as problem:
        sentence = f"{shown(problem.filename or options.movie)}: {problem.strerror or problem}"
    else:
        return 0
    print(f"make_player.py: {sentence}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
