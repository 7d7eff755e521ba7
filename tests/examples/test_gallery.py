#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""The gallery page is what its script makes of the results that are kept, names programs that exist, and can be read.

Without Chromium the last is left out (exit status 77, skipped).
"""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests" / "validation"), str(ROOT / "examples" / "gallery")]

import browser  # noqa: E402
import make_gallery  # noqa: E402

FOLDER = ROOT / "examples" / "gallery"
CONTRAST = """const linear = c => (c /= 255) <= .03928 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4;
    const light = css => { const [r, g, b] = css.match(/[\\d.]+/g).map(Number); return .2126 * linear(r) + .7152 * linear(g) + .0722 * linear(b); };
    const ground = node => { for (; node; node = node.parentElement) { const c = getComputedStyle(node).backgroundColor;
        if (!c.endsWith(", 0)") && c !== "transparent") return c; } return "rgb(255, 255, 255)"; };
    return Math.min(...[...document.querySelectorAll("h1,h2,p,pre,a,figcaption,blockquote,span")].map(node => {
        const pair = [light(getComputedStyle(node).color), light(ground(node))].sort((a, b) => b - a);
        return (pair[0] + .05) / (pair[1] + .05); }));"""


class Page(unittest.TestCase):
    def setUp(self):
        self.experiments = make_gallery.read("experiments.json")
        self.results = make_gallery.read("results.json")

    def test_it_is_what_the_script_makes(self):
        self.assertEqual((FOLDER / "index.html").read_text(), make_gallery.page(self.experiments, self.results))

    def test_every_experiment_is_there_with_its_pictures_and_what_it_printed(self):
        self.assertGreater(len(self.experiments), 0)
        for experiment in self.experiments:
            name = experiment["name"]
            self.assertTrue((ROOT / "examples" / f"{name}.cpp").exists(), name)
            self.assertIn(name, self.results)
            for picture in experiment["pictures"]:
                self.assertTrue((FOLDER / picture["png"]).exists(), picture)
                self.assertLess((FOLDER / picture["png"]).stat().st_size, 300_000, picture)
            for run in self.results[name]:
                said, lines = make_gallery.certificate(run["printed"])
                self.assertGreater(len(said), 0, name)
                self.assertGreater(len(lines), 0, name)
                self.assertEqual(run["code"], 0 if all(s.startswith("certified") for s in said) else 3, name)

    def test_what_is_wrong_is_told_in_one_sentence(self):
        with self.assertRaisesRegex(make_gallery.GalleryError, "no experiment is called 'nothing'"):
            make_gallery.run_all(["nothing"], None, {})
        self.assertEqual(make_gallery.certificate("a\nnot certified: b\n"), (["not certified: b"], ["a"]))


class Findings(unittest.TestCase):
    def test_means_of_seeds_are_shown_with_their_errors(self):
        runs = [{"found": [["angle", "degrees", 20.0 + k], ["never", "-", None]]} for k in (1, 2, 3)]
        table = make_gallery.found_table(runs)
        self.assertIn("<td>angle</td><td>22 ± 0.58</td><td>degrees</td>", table)
        self.assertNotIn("never", table)
        self.assertEqual(make_gallery.found_table(runs[:1]), "")
        self.assertEqual(make_gallery.found_table([{}, {}]), "")

    def test_they_are_read_from_what_the_experiment_wrote(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            self.assertEqual(make_gallery.findings(out), [])
            (out / "findings.csv").write_text("finding,unit,value\nangle,degrees,1.5\nnever,-,nan\n")
            self.assertEqual(make_gallery.findings(out), [["angle", "degrees", 1.5], ["never", "-", None]])


@unittest.skipUnless(browser.installed(), "Chromium is missing")
class Shown(unittest.TestCase):
    def test_it_can_be_read_at_any_width_in_light_and_dark(self):
        window = browser.Browser()
        self.addCleanup(window.close)
        for scheme in ("light", "dark"):
            window.prefer(scheme)
            for width in (320, 700, 1280):
                window.resize(width, 900)
                window.open((FOLDER / "index.html").as_uri())
                wide, inner = window.run("return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
                self.assertLessEqual(wide, inner, f"{scheme}, {width}")
                missing = window.run("document.querySelectorAll('img').forEach(i => i.loading = 'eager');"
                                     "return [...document.images].filter(i => !i.getAttribute('src') || !i.alt).length")
                self.assertEqual(missing, 0)
                self.assertGreater(window.run(CONTRAST), 4.5, f"{scheme}, {width}")
            self.assertTrue(window.wait("return [...document.images].every(i => i.complete && i.naturalWidth > 100)"))
        self.assertEqual(window.console(), [])


if __name__ == "__main__":
    result = unittest.main(verbosity=2, exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if not browser.installed() else 0)
