#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes players of movies, opens them from disk in headless Chromium without network, and plays them.

What the script refuses is tested anywhere. Without Chromium that is all (exit status 77, skipped), without three.js
only movies of the plane are played.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests" / "validation"), str(ROOT / "examples" / "player")]

import browser  # noqa: E402
import make_player  # noqa: E402
import sample_movie  # noqa: E402

SCRIPT = ROOT / "examples" / "player" / "make_player.py"
OPTIONS = argparse.Namespace(screenshots=None, movie=[])
PAINTED = "return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))"
SHOWN = "return [talusPlayer.state.k, talusPlayer.state.time, talusPlayer.state.playing]"


def make(*arguments, **environment):
    return subprocess.run([sys.executable, "-B", str(SCRIPT), *map(str, arguments)], text=True, capture_output=True, timeout=120,
                          env={**os.environ, **environment})


def three():
    """Whether three.js is where the script looks for it."""
    try:
        make_player.three_folder(os.environ.get("TALUS_THREE"))
    except make_player.MovieError:
        return False
    return True


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="talus-player-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.movie, self.html = self.folder / "run.movie", self.folder / "run.html"

    def made(self, text, *options, **environment):
        self.movie.write_bytes(text if isinstance(text, bytes) else text.encode())
        return make(self.movie, self.html, *options, **environment)

    def refused(self, text, sentence, *options, **environment):
        """One sentence, status 2, and the page that was there before."""
        for before in (None, "as it was"):
            if before:
                self.html.write_text(before)
            run = self.made(text, *options, **environment)
            self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(sentence, run.stderr)
            self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["run.html"] * bool(before) + ["run.movie"])
            if before:
                self.assertEqual(self.html.read_text(), before)
        self.html.unlink()

    def test_what_is_no_movie_is_refused(self):
        lines = sample_movie.movie(2)
        whole = sample_movie.text(lines)
        first = whole.index("\n")
        begun = "but must begin with the line of a talus movie"
        self.refused("", f"is empty, {begun}")
        self.refused(whole[:first], f"is cut off in its first line, or no movie, {begun}")
        self.refused(whole[:first // 2], f"is cut off in its first line, or no movie, {begun}")
        self.refused(b"\xff\xfe\0\n", f"or no movie, {begun}")
        self.refused("time [s],load [N]\n1,2\n", f"or no movie, {begun}")
        self.refused('{"a":1}\n', 'format of ')
        self.refused(sample_movie.text([sample_movie.header(2, version=2)]), "is 2, but must be 1")
        self.refused(sample_movie.text([sample_movie.header(4)]), "dimension of ")
        self.refused(sample_movie.text([sample_movie.header(2, title=None)]), "is null, but must be words")
        self.refused(whole[:first + 1], "holds no frame, but must hold at least one")

    def test_a_bad_line_is_named(self):
        lines = sample_movie.movie(2)
        last = len(lines)
        def changed(**entries):
            return sample_movie.text([*lines[:-1], {**lines[-1], **entries}])
        self.refused(changed(time=0.0), f"line {last} of {self.movie} has the time 0.0, but must have one later")
        self.refused(changed(bodies=[1]), f"line {last} of {self.movie} names bodies whose shapes were not told")
        self.refused(changed(positions=[1.0]), "has 1 numbers as positions, but must have 24")
        self.refused(changed(rotations=["a"] * 12), "has rotations that are no numbers")
        self.refused(changed(positions=[1e300] * 24), "has positions beyond 32 bit floats")
        self.refused(changed(scalars=[]), "has 0 numbers as scalars, but must have 12")
        self.refused(sample_movie.text(lines) + "{NaN}\n", f"line {last + 1} of {self.movie} is neither that of a body nor a frame")
        again = {"body": 0, "shape": {"kind": "unbounded"}}
        self.refused(sample_movie.text([*lines, again]), "tells of body 0, but must of one that was not told of")
        for shape, sentence in ((None, "has no shape"), ({"kind": "cone"}, 'kind "cone", but known are ball'),
                                ({"kind": "ball", "radius": "1", "centre": [0, 0]}, "has radius of a ball that are no numbers"),
                                ({"kind": "core", "radius": 0, "vertices": [0, 0], "faces": [[0, 1]]}, "no loops of its vertices")):
            self.refused(sample_movie.text([*lines, {"body": 1, "shape": shape}]), sentence)

    def test_files_that_are_not_there(self):
        run = make(self.folder / "no.movie", self.html)
        self.assertEqual((run.returncode, run.stderr), (2, f"make_player.py: {self.folder / 'no.movie'}: No such file or directory\n"))
        self.movie.write_text(sample_movie.text(sample_movie.movie(2)))
        for place in (self.folder / "no" / "run.html", self.folder):
            run = make(self.movie, place)
            self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1), run.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["run.movie"])

    def test_space_needs_three(self):
        whole = sample_movie.text(sample_movie.movie(3))
        self.refused(whole, f"a movie of space needs three.js, which is not in {self.folder / 'no'}; install it by", "--three", self.folder / "no")
        self.refused(whole, "a movie of space needs three.js", TALUS_THREE=str(self.folder))
        with tempfile.TemporaryDirectory() as other:
            (pathlib.Path(other) / "package.json").write_text('{"version": "0.111.0"}')
            self.refused(whole, "is of version 0.111.0, but must be of 0.170.*", "--three", other)
        # A movie of the plane does not.
        self.assertEqual(self.made(sample_movie.text(sample_movie.movie(2)), "--three", self.folder).returncode, 0)

    def test_what_a_killed_run_left_is_played(self):
        lines = sample_movie.movie(2)
        whole = sample_movie.text(lines)
        for end in (1, 30, 200):
            self.assertEqual(self.made(whole[:-end]).returncode, 0)
        mode = self.html.stat().st_mode & 0o777
        mask = os.umask(0)
        os.umask(mask)
        self.assertEqual(mode, 0o666 & ~mask)
        page = self.html.read_text()
        content = json.loads(page.split('id="movie">')[1].split("</script>")[0])
        self.assertEqual(len(content["frames"]), 40)
        self.assertNotIn("http", page.replace("http-equiv", ""))


@unittest.skipUnless(browser.installed(), "Chromium not found")
class Player(unittest.TestCase):
    """One page for each test; no complaint on the console and nothing fetched."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="talus-player-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.browser = browser.Browser(browser.IN_SPACE)
        cls.addClassCleanup(cls.browser.close)
        cls.browser.disconnect()
        cls.pages = {}

    def page(self, dimension):
        if dimension == 3 and not three():
            self.skipTest("three.js not found")
        if dimension not in self.pages:
            movie, html = (pathlib.Path(self.folder.name) / f"{dimension}.{end}" for end in ("movie", "html"))
            movie.write_text(sample_movie.text(sample_movie.movie(dimension)))
            run = make(movie, html)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.pages[dimension] = html.as_uri()
        return self.pages[dimension]

    def setUp(self):
        self.browser.resize(1000, 760)
        self.browser.prefer("light")
        self.browser.open("about:blank")
        self.browser.console()
        self.browser.requests()
        self.opened = []

    def go(self, address):
        self.browser.open(address)
        self.browser.wait("return window.talusPlayer && !document.querySelector('#stage p')")
        self.browser.run(PAINTED)
        self.opened.append(address)

    def tearDown(self):
        complaints = [line for line in self.browser.console() if "GL Driver Message" not in line]  # on the machine, not the page
        self.assertEqual(complaints, [])
        self.assertEqual([url for url in self.browser.requests() if not url.startswith(("data:", "about:", *self.opened))], [])

    def choose(self, selector, value):
        self.browser.run("const s = document.querySelector(arguments[0]); s.value = arguments[1]; s.dispatchEvent(new Event('change'))",
                         selector, value)

    def slide(self, k):
        self.browser.run("const s = document.querySelector('#slider'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))", k)

    def each(self):
        for dimension in (2, 3):
            with self.subTest(dimension=dimension):
                self.go(self.page(dimension))
                yield dimension

    def colours(self, selector="#stage canvas"):
        """Of how many colours what is drawn is: told by a screenshot, drawn anew into a canvas."""
        self.browser.run(PAINTED)
        shot = self.browser.command("Page.captureScreenshot")["data"]
        return self.browser.run("""
            const box = document.querySelector(arguments[0]).getBoundingClientRect(), image = new Image();
            image.src = "data:image/png;base64," + arguments[1];
            return image.decode().then(() => {
                const canvas = new OffscreenCanvas(box.width, box.height), context = canvas.getContext("2d");
                context.drawImage(image, -box.x, -box.y);
                const pixels = new Uint32Array(context.getImageData(0, 0, box.width, box.height).data.buffer), found = new Map();
                for (const pixel of pixels) found.set(pixel, (found.get(pixel) || 0) + 1);
                let sum = 0;
                for (let i = 0; i < pixels.length; ++i) sum = (31 * sum + pixels[i]) % 4294967291;
                return {colours: found.size, blank: Math.max(...found.values()) / pixels.length, sum};
            })""", selector, shot)

    def test_it_plays_to_the_end(self):
        for _ in self.each():
            self.assertEqual(self.browser.run(SHOWN), [0, 0, False])
            self.assertEqual(self.browser.run("return document.querySelector('#time').textContent"), "0.000 s / 2.000 s")
            before = self.colours()
            self.assertGreater(before["colours"], 20)
            self.assertLess(before["blank"], 0.95)
            self.choose("#speed", "0.1")  # slower than any machine
            self.browser.click("#play")
            self.browser.wait("return talusPlayer.state.k > 1 && talusPlayer.state.playing")
            self.assertEqual(self.browser.run("return document.querySelector('#play').getAttribute('aria-label')"), "Pause")
            self.browser.click("#play")
            k, time, playing = self.browser.run(SHOWN)
            self.assertFalse(playing)
            self.assertLessEqual(0.05 * k, time + 1e-9)
            self.assertNotEqual(self.colours()["sum"], before["sum"])
            self.choose("#speed", "10")
            self.browser.click("#play")
            self.browser.wait("return talusPlayer.state.k === 40 && !talusPlayer.state.playing")
            self.assertEqual(self.browser.run("return document.querySelector('#time').textContent"), "2.000 s / 2.000 s")

    def test_slider_and_keys(self):
        for _ in self.each():
            self.slide(30)
            self.assertEqual(self.browser.run("return document.querySelector('#time').textContent"), "1.500 s / 2.000 s")
            self.browser.run("document.activeElement.blur()")
            for key, k in (("\ue014", 31), ("\ue012", 30), ("\ue011", 0), ("\ue012", 0), ("\ue010", 40)):
                self.browser.press(key)
                self.assertEqual(self.browser.run(SHOWN)[0], k)
                self.assertEqual(int(self.browser.run("return document.querySelector('#slider').value")), k)
            self.choose("#speed", "0.1")
            self.browser.press(" ")  # from the end it begins again
            self.browser.run("document.activeElement.blur()")
            self.assertLess(self.browser.wait("return talusPlayer.state.playing && talusPlayer.state.k + 1"), 30)
            self.browser.press(" ")
            self.assertFalse(self.browser.run(SHOWN)[2])
            self.browser.run("document.querySelector('#play').focus()")
            self.browser.press(" ")  # of the button itself: once, not twice
            self.assertTrue(self.browser.run(SHOWN)[2])
            self.browser.press("\ue014")
            self.assertFalse(self.browser.run(SHOWN)[2])

    def test_the_mouse(self):
        for dimension in self.each():
            fitted = self.colours()["sum"]
            self.browser.drag("#stage canvas", 90, 40)
            moved = self.colours()["sum"]
            self.assertNotEqual(moved, fitted)
            self.browser.wheel("#stage canvas", -240)
            zoomed = self.colours()["sum"]
            self.assertNotEqual(zoomed, moved)
            self.browser.click("#fit")
            self.assertEqual(self.colours()["sum"], fitted, dimension)

    def test_shades(self):
        for _ in self.each():
            legend = "const l = document.querySelector('.legend'); return l.hidden ? '' : l.querySelector('p').textContent"
            self.assertEqual(self.browser.run(legend), "load [mean grain weights]")
            ticks = self.browser.run("return [...document.querySelectorAll('.ticks span')].map(t => Number(t.textContent))")
            self.assertEqual(ticks[0], 0)
            self.assertGreater(len(ticks), 1)
            by_load = self.colours()["sum"]
            self.choose("#shading", "plain")
            self.assertNotEqual(self.colours()["sum"], by_load)
            self.assertEqual(self.browser.run(legend), "")

    def test_words_stay_text(self):
        for _ in self.each():
            title = "Every kind <b>of</b> shape"
            self.assertEqual(self.browser.run("return [document.querySelector('h1').textContent, document.title]"), [title, title])

    def test_no_horizontal_scroll_in_light_and_dark(self):
        for dimension in self.each():
            for width in (320, 800, 1400):
                for scheme in ("light", "dark"):
                    self.browser.resize(width, 800)
                    self.browser.prefer(scheme)
                    self.slide(24)
                    self.browser.run(PAINTED)
                    page, window, tall, height = self.browser.run(
                        "const r = document.documentElement; return [r.scrollWidth, r.clientWidth, r.scrollHeight, r.clientHeight]")
                    self.assertLessEqual((page, tall), (window, height), (dimension, width, scheme))
                    stage = self.browser.run("const s = document.querySelector('#stage'); return [s.clientWidth, s.clientHeight]")
                    self.assertGreater(stage[1], 300)
                    self.shot(f"player-{dimension}d-{width}-{scheme}")

    def test_movies_given(self):
        """Real ones, to be looked at (--movie)."""
        for path in OPTIONS.movie:
            html = pathlib.Path(self.folder.name) / "given.html"
            run = make(path, html)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.browser.resize(1280, 860)
            for scheme in ("light", "dark"):
                self.browser.prefer(scheme)
                self.go(html.as_uri())
                for share in (0, 0.3, 1):
                    self.slide(round(share * (self.browser.run("return talusPlayer.frameCount") - 1)))
                    self.browser.run(PAINTED)
                    self.shot(f"{path.stem}-{scheme}-{share}")

    def shot(self, name):
        if OPTIONS.screenshots:
            OPTIONS.screenshots.mkdir(parents=True, exist_ok=True)
            self.browser.screenshot(OPTIONS.screenshots / f"{name}.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--screenshots", type=pathlib.Path, metavar="FOLDER", help="keep pictures of the players there")
    parser.add_argument("--movie", type=pathlib.Path, action="append", default=[], help="another movie to be pictured")
    options, rest = parser.parse_known_args()
    vars(OPTIONS).update(vars(options))
    if not browser.installed():
        print("skipped, Chromium not found: what the script refuses is tested alone")
    elif not three():
        print("skipped, three.js not found: movies of the plane are tested alone")
    tests = unittest.main(argv=[sys.argv[0], *rest], exit=False)
    if not tests.result.wasSuccessful():
        sys.exit(1)
    sys.exit(0 if browser.installed() else 77)


if __name__ == "__main__":
    main()
