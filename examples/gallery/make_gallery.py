#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: make_gallery.py [--run NAME...] [--programs FOLDER] [--seeds N] [--work FOLDER] [--jobs N]

Writes index.html beside this script from experiments.json (what each experiment is, and what the paper says of it),
results.json (what the experiments printed) and the small pictures. With --run the named experiments (all: --run all) are
run first, for as many seeds as asked, and their results and pictures take the place of the old ones: pictures need
Chromium, programs are those of FOLDER (build/examples/examples). Exit code 1 if an experiment failed, 2 for what is wrong.
"""
import argparse
import concurrent.futures
import csv
import html
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
WIDTH = 720  # of a picture [pixels]

STYLE = """
:root { color-scheme: light dark; --paper: #fbfaf7; --ink: #1d1d1f; --soft: #5d5d63; --line: #d9d6cf; --card: #fff; --link: #0b57a4; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #17181a; --ink: #ececec; --soft: #a9abb0; --line: #3a3c40; --card: #202225; --link: #8cbcf0; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 Georgia, "DejaVu Serif", serif; }
main { max-width: 78rem; margin: 0 auto; padding: 1.5rem 1rem 4rem; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; } h2 { font-size: 1.25rem; margin: 0 0 .4rem; }
a { color: var(--link); } p { margin: .4rem 0; overflow-wrap: anywhere; }
nav { display: flex; flex-wrap: wrap; gap: .2rem .9rem; margin: 1rem 0 2rem; }
article { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 1.2rem; padding: 1.4rem 0;
  border-top: 1px solid var(--line); }
@media (max-width: 52rem) { article { grid-template-columns: minmax(0, 1fr); } }
figure { margin: 0 0 .8rem; } figure img { width: 100%; height: auto; display: block; background: #fff; border: 1px solid var(--line); }
figcaption, .note { color: var(--soft); font-size: .88rem; }
blockquote { margin: .4rem 0; padding-left: .8rem; border-left: 3px solid var(--line); color: var(--soft); }
pre { margin: .5rem 0; padding: .6rem .7rem; background: var(--card); border: 1px solid var(--line); font: 13px/1.45 "DejaVu Sans Mono",
  monospace; white-space: pre-wrap; overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: .88rem; margin: .5rem 0; } caption { text-align: left; color: var(--soft); }
td { padding: .1rem .8rem .1rem 0; vertical-align: top; }
.certified { color: #1a7f37; } .missed { color: #b3261e; } @media (prefers-color-scheme: dark) { .certified { color: #6fd08c; }
  .missed { color: #ff9b93; } }
"""


class GalleryError(Exception):
    pass


def read(name):
    path = HERE / name
    try:
        return json.loads(path.read_text())
    except FileNotFoundError:
        raise GalleryError(f"{path} is missing, but must be there") from None
    except json.JSONDecodeError as error:
        raise GalleryError(f"{path} is no JSON: {error}") from None


def certificate(text):
    """The lines of what a program printed that say whether it can be believed, and the others."""
    lines = [line.rstrip() for line in text.splitlines()]
    said = [line for line in lines if re.match(r"(not )?certified: ", line)]
    return said, [line for line in lines if line not in said]


def to_png(svg, png, width=WIDTH):
    """A small picture of a drawing, by Chromium."""
    browser = next((path for path in map(shutil.which, ("chromium", "google-chrome")) if path), None)
    if browser is None:
        raise GalleryError("Chromium is missing, but must be there to make pictures")
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg.read_text())
    if not size:
        raise GalleryError(f"{svg} has no size, but must be a drawing")
    height = round(float(size[2]) * width / float(size[1]))
    with tempfile.TemporaryDirectory(prefix="talus-gallery-") as folder:
        page = pathlib.Path(folder) / "page.html"
        page.write_text(f'<body style="margin:0"><img src="{svg.resolve().as_uri()}" width="{width}" height="{height}">')
        subprocess.run([browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--user-data-dir={folder}/profile",
                        f"--screenshot={png}", f"--window-size={width},{height}", page.as_uri()],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120)
    optimised = shutil.which("optipng")
    if optimised:
        subprocess.run([optimised, "-quiet", str(png)], check=False)


def perform(experiment, seed, programs, work):
    """Runs an experiment; what it printed, its exit code and its seconds."""
    out = work / f"{experiment['name']}-{seed}"
    program = programs / experiment["name"]
    if not program.exists():
        raise GalleryError(f"{program} is missing, but must be built")
    begin = time.monotonic()
    run = subprocess.run([str(program), *experiment.get("options", []), "--seed", str(seed), "--out", str(out), "--quiet", "--fresh"],
                         capture_output=True, text=True)
    return {"seed": seed, "code": run.returncode, "seconds": round(time.monotonic() - begin), "printed": run.stdout,
            "complaint": run.stderr.strip(), "found": findings(out)}, out


def findings(out):
    """What an experiment found, [name, unit, value] for each; a value that is none is null."""
    try:
        with open(out / "findings.csv", newline="") as file:
            rows = [(row["finding"], row["unit"], float(row["value"])) for row in csv.DictReader(file)]
    except FileNotFoundError:
        return []
    return [[name, unit, value if math.isfinite(value) else None] for name, unit, value in rows]


def found_table(runs):
    """Means of what several runs found, with their standard errors."""
    lines = []
    for name, unit, _ in runs[0].get("found", []):
        values = [value for run in runs for other, _, value in run.get("found", []) if other == name and value is not None]
        if len(values) < 2:
            continue
        error = statistics.stdev(values) / math.sqrt(len(values))
        lines.append(f"<tr><td>{html.escape(name)}</td><td>{statistics.fmean(values):.4g} ± {error:.2g}</td>"
                     f"<td>{html.escape(unit)}</td></tr>")
    if not lines:
        return ""
    return f'<table><caption>Means of {len(runs)} seeds, with their standard errors</caption>{"".join(lines)}</table>'


def run_all(names, options, results):
    experiments = {e["name"]: e for e in read("experiments.json")}
    wanted = list(experiments) if names == ["all"] else names
    for name in wanted:
        if name not in experiments:
            raise GalleryError(f"no experiment is called '{name}'; there are: {' '.join(experiments)}")
    failed = False
    with tempfile.TemporaryDirectory(prefix="talus-gallery-") as temporary, \
            concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        work = pathlib.Path(options.work or temporary)
        jobs = {pool.submit(perform, experiments[name], seed, pathlib.Path(options.programs), work): (name, seed)
                for name in wanted for seed in range(1, 1 + (options.seeds if experiments[name].get("statistical") else 1))}
        done = {}
        for k, job in enumerate(concurrent.futures.as_completed(jobs)):
            name, seed = jobs[job]
            result, out = job.result()
            print(f"[{k + 1}/{len(jobs)}] {name}, seed {seed}: exit code {result['code']}, {result['seconds']} s", flush=True)
            failed |= result["code"] not in (0, 3)
            done.setdefault(name, []).append(result)
            if seed == 1:
                for picture in experiments[name]["pictures"]:
                    to_png(out / picture["file"], HERE / picture["png"])
            results[name] = sorted(done[name], key=lambda run: run["seed"])  # at once: what follows may be stopped
            (HERE / "results.json").write_text(json.dumps(results, indent=1, sort_keys=True) + "\n")
    return failed


def article(experiment, runs):
    text = lambda words: html.escape(words, quote=True)  # noqa: E731
    name, parts = experiment["name"], []
    for picture in experiment["pictures"]:
        if (HERE / picture["png"]).exists():
            parts.append(f'<figure><img src="{text(picture["png"])}" alt="{text(picture["caption"])}" loading="lazy">'
                         f'<figcaption>{text(picture["caption"])}</figcaption></figure>')
    command = " ".join(["examples/run", name, *experiment.get("options", [])])
    words = [f'<h2 id="{name}">{text(experiment["title"])}</h2>', f'<p>{text(experiment["about"])}</p>']
    if experiment.get("paper"):
        words.append(f'<blockquote>{text(experiment["paper"])}</blockquote>')
    words.append(f"<pre>{text(command)}</pre>")
    words.append(found_table(runs))
    for run in runs:
        said, lines = certificate(run["printed"])
        believed = run["code"] == 0
        label = f"Seed {run['seed']}, {run['seconds']} s of work: " if len(runs) > 1 else f"{run['seconds']} s of work: "
        worst = f' title="{text(said[-1])}"' if said else ""
        words.append(f'<p class="note">{label}<span class="{"certified" if believed else "missed"}"{worst}>'
                     f'{"certified" if believed else "not certified"}</span></p>')
        words.append(f'<pre>{text(chr(10).join(lines))}</pre>')
    return f'<article>\n<div>{"".join(parts)}</div>\n<div>{"".join(words)}</div>\n</article>'


def page(experiments, results):
    shown = [e for e in experiments if e["name"] in results]
    links = " ".join(f'<a href="#{e["name"]}">{html.escape(e["title"])}</a>' for e in shown)
    body = "\n".join(article(e, results[e["name"]]) for e in shown)
    return f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>talus: experiments</title>
<style>{STYLE}</style>
<main>
<h1>talus: experiments</h1>
<p>What each program of <code>examples/</code> shows, with its command, what it printed, and whether all of its steps can be believed.
Written by make_gallery.py; changes by hand are lost.</p>
<nav>{links}</nav>
{body}
</main>
</html>
"""


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", nargs="+", metavar="NAME", default=[], help="experiments to run first, or all")
    parser.add_argument("--programs", default=str(ROOT / "build/examples/examples"), help="where they are built")
    parser.add_argument("--seeds", type=int, default=3, help="of those that are statistical (3)")
    parser.add_argument("--work", help="folder for their results, kept; by default one that is taken away")
    parser.add_argument("--jobs", type=int, default=1, help="at a time (1)")
    options = parser.parse_args(arguments)
    try:
        experiments = read("experiments.json")
        results = read("results.json") if (HERE / "results.json").exists() else {}
        failed = run_all(options.run, options, results) if options.run else False
        (HERE / "index.html").write_text(page(experiments, results))
    except GalleryError as error:
        print(f"make_gallery.py: {error}", file=sys.stderr)
        return 2
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
