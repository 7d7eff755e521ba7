#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Makes performance profiles of a run of bench_solvers: an SVG, a page and a text table.

profile.svg: for every tolerance and solver, the share of all problems that it solved within a factor of the
fastest solver's time on the same problem (Dolan and More 2002). profile.html: the same picture, all times, failures.
"""
import argparse
import html
import json
import math
import pathlib
import re
import sys

MOST_CURVES = 8
# Readable on light and on dark ground (Okabe and Ito 2008, black and yellow replaced).
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7f7f7f", "#e69f00", "#56b4e9", "#8c564b"]
DASHES = ["", "7 3", "2 3", "9 3 2 3"]


class Results:
    """Times [s] of solved runs by (tolerance, problem, solver); None for a failure; absent: not applicable."""

    def __init__(self):
        self.time = {}
        self.residual = {}
        self.spent = {}  # also by failures
        self.context = {}
        self.contacts = {}

    @classmethod
    def of(cls, report):
        results = cls()
        results.context = report.get("context", {})
        unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
        for run in report["benchmarks"]:
            if run.get("error_occurred") or run.get("run_type", "iteration") != "iteration":
                continue
            problem, solver, tolerance = run["name"].split("/")[:3]
            key = tolerance, problem, solver
            solved = run["solved"] == 1
            time = max(run["real_time"] * unit[run["time_unit"]], 1e-9)
            earlier = results.time.get(key)
            if key not in results.time or (solved and (earlier is None or time < earlier)):
                results.time[key] = time if solved else None
                results.residual[key] = run["residual"]
                results.spent[key] = time
            results.contacts[problem] = int(run["contacts"])
        return results

    def _names(self, place):
        return list(dict.fromkeys(key[place] for key in self.time))

    def tolerances(self):
        return sorted(self._names(0), key=float, reverse=True)

    def problems(self):
        return self._names(1)

    def solvers(self):
        return self._names(2)

    def applies(self, tolerance, problem, solver):
        return (tolerance, problem, solver) in self.time


def ratios(results, tolerance, solver):
    """Ratio to the best time of every problem the solver applies to, ascending; infinite for a failure."""
    found = []
    for problem in results.problems():
        if not results.applies(tolerance, problem, solver):
            continue
        time = results.time[tolerance, problem, solver]
        found.append(math.inf if time is None else time / best(results, tolerance, problem))
    return sorted(found)


def best(results, tolerance, problem):
    """The virtual best: the time of the fastest solver on a problem; None if none solved it."""
    times = [results.time.get((tolerance, problem, solver)) for solver in results.solvers()]
    return min((t for t in times if t is not None), default=None)


def profile(found, factor):
    """Share of the problems solved within `factor` of the best time."""
    return sum(r <= factor * (1 + 1e-12) for r in found) / len(found) if found else 0.0


def geometric_mean(found):
    """Of the finite ones; None without any."""
    logs = [math.log(r) for r in found if math.isfinite(r)]
    return math.exp(sum(logs) / len(logs)) if logs else None


def curve(found, last):
    """Corners of the profile from factor 1 to `last`."""
    points = [(1.0, profile(found, 1.0))]
    for r in sorted({r for r in found if 1.0 < r <= last}):
        points += [(r, points[-1][1]), (r, profile(found, r))]
    return points + [(last, points[-1][1])]


def chosen(results):
    """The solvers worth a curve: those that stand highest on average over the factor's logarithm."""
    grid = [10 ** (k / 10) for k in range(31)]

    def height(solver):
        return sum(profile(ratios(results, t, solver), g) for t in results.tolerances() for g in grid)
    kept = set(sorted(results.solvers(), key=height, reverse=True)[:MOST_CURVES])
    return [solver for solver in results.solvers() if solver in kept]


STYLE = """
.ground { fill: #fff } .ink { fill: #222 } .soft { fill: #555 } .frame { stroke: #888; fill: none }
.grid { stroke: #ddd } text { font: 12px system-ui, sans-serif } .title { font-size: 14px; font-weight: 600 }
@media (prefers-color-scheme: dark) {
  .ground { fill: #15181c } .ink { fill: #e8e8e8 } .soft { fill: #aaa } .grid { stroke: #333 } }
"""


class Panel:
    """The axes of one tolerance."""
    width, height = 300, 200

    def __init__(self, left, top, last):
        self.left, self.top, self.last = left, top, last

    def x(self, factor):
        return self.left + self.width * math.log(factor) / math.log(self.last)

    def y(self, share):
        return self.top + self.height * (1 - share)

    def axes(self, title, remark):
        bottom, right = self.top + self.height, self.left + self.width
        out = [f'<text class="ink title" x="{self.left}" y="{self.top - 8}">{html.escape(title)}</text>'
               f'<text class="soft" x="{right}" y="{self.top - 8}" text-anchor="end">{html.escape(remark)}</text>']
        for k in range(round(math.log10(self.last)) + 1):
            x = self.x(10 ** k)
            out.append(f'<path class="grid" d="M{x:.1f} {self.top}V{bottom}"/>'
                       f'<text class="soft" x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{10 ** k}</text>')
        for k in range(5):
            y = self.y(k / 4)
            out.append(f'<path class="grid" d="M{self.left} {y:.1f}H{right}"/>'
                       f'<text class="soft" x="{self.left - 6}" y="{y + 4:.1f}" text-anchor="end">{25 * k} %</text>')
        out.append(f'<rect class="frame" x="{self.left}" y="{self.top}" width="{self.width}" '
                   f'height="{self.height}"/>')
        middle = (self.left + right) / 2
        out.append(f'<text class="ink" x="{middle}" y="{bottom + 34}" text-anchor="middle">'
                   'time / time of the fastest solver</text>')
        turned = f"translate({self.left - 46} {self.top + self.height / 2}) rotate(-90)"
        out.append(f'<text class="ink" transform="{turned}" text-anchor="middle">problems solved</text>')
        return out


def svg(results):
    solvers, tolerances = chosen(results), results.tolerances()
    every = [r for t in tolerances for s in solvers for r in ratios(results, t, s) if math.isfinite(r)]
    last = 10 ** min(max(1, math.ceil(math.log10(max(every, default=10)))), 4)
    columns = min(2, len(tolerances))
    rows = math.ceil((len(tolerances) + 1) / 2) if len(tolerances) > 1 else 2
    step_x, step_y = Panel.width + 90, Panel.height + 80
    wide, high = 10 + 390 * max(columns, 1) + 20, rows * step_y + 10
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" width="{wide}" height="{high}" '
           f'role="img" aria-label="Performance profiles"><style>{STYLE}</style>'
           f'<rect class="ground" width="{wide}" height="{high}"/>']
    places = [(70 + step_x * (k % columns), 30 + step_y * (k // columns)) for k in range(len(tolerances) + 1)]
    for (left, top), tolerance in zip(places, tolerances):
        panel = Panel(left, top, last)
        count = sum(best(results, tolerance, p) is not None for p in results.problems())
        out += panel.axes(f"residual ≤ {tolerance}", f"{count} of {len(results.problems())} solved by some")
        for k, solver in enumerate(solvers):
            found = ratios(results, tolerance, solver)
            if not found:
                continue
            points = " ".join(f"{panel.x(x):.1f},{panel.y(y):.1f}" for x, y in curve(found, last))
            out.append(f'<polyline points="{points}" {line(k)}><title>{html.escape(solver)}</title></polyline>')
    left, top = places[-1]
    for k, solver in enumerate(solvers):
        y = top + 14 + 22 * k
        out.append(f'<path d="M{left - 30} {y}h36" {line(k)}/>'
                   f'<text class="ink" x="{left + 14}" y="{y + 4}">{html.escape(solver)}'
                   f'<tspan class="soft" dx="6">{note(results, solver)}</tspan></text>')
    dropped = len(results.solvers()) - len(solvers)
    if dropped:
        y = top + 14 + 22 * len(solvers)
        out.append(f'<text class="soft" x="{left - 30}" y="{y + 4}">without a curve, being lower: {dropped}</text>')
    return "\n".join(out + ["</svg>\n"])


def line(k):
    dash = DASHES[k // 2 % len(DASHES)]
    return (f'fill="none" stroke="{COLOURS[k]}" stroke-width="2.2" stroke-linejoin="round"'
            + (f' stroke-dasharray="{dash}"' if dash else ""))


def note(results, solver):
    """Of the legend: on how many problems the solver ran, where not on all."""
    count = len({p for _, p, s in results.time if s == solver})
    total = len(results.problems())
    return "" if count == total else f"({count} of {total} problems)"


def text_of_time(seconds):
    return "–" if seconds is None else f"{1e3 * seconds:.3g}"


def total(results, tolerance, solver):
    """Time [s] for all problems the solver applies to, failures at the limit."""
    limit = float(results.context.get("limit_seconds", "nan"))
    return sum(limit if time is None else time for (t, _, s), time in results.time.items()
               if (t, s) == (tolerance, solver))


def summary(results, tolerance):
    """Rows (solver, solved, failed, geometric mean of the ratios to the best, share within 2, total time)."""
    rows = []
    for solver in results.solvers():
        found = ratios(results, tolerance, solver)
        if found:
            failed = sum(not math.isfinite(r) for r in found)
            rows.append((solver, len(found) - failed, failed, geometric_mean(found), profile(found, 2.0),
                         total(results, tolerance, solver)))
    return rows


def machine(results):
    context = results.context
    items = [context.get("processor", "unknown processor"), context.get("compiler"), context.get("date"),
             f"limit {float(context['limit_seconds']):g} s" if "limit_seconds" in context else None,
             f"measure {context['measure']}" if "measure" in context else None,
             f"peers in {context['peer_units']} units" if "peer_units" in context else None]
    return ", ".join(item for item in items if item)


def mean_text(mean):
    return "–" if mean is None else f"{mean:.2f}"


def plain(results):
    """Everything as text."""
    out = [machine(results), ""]
    solvers = results.solvers()
    width = max(map(len, results.problems()), default=0)
    for tolerance in results.tolerances():
        out.append(f"residual <= {tolerance}: time [ms] (ratio to the best); - failed, blank does not apply")
        out.append(" ".join([f"{'problem':{width}}"] + [f"{s:>22}" for s in solvers]))
        for problem in results.problems():
            row = [f"{problem:{width}}"]
            fastest = best(results, tolerance, problem)
            for solver in solvers:
                text = ""
                if results.applies(tolerance, problem, solver):
                    time = results.time[tolerance, problem, solver]
                    text = "-" if time is None else f"{1e3 * time:.3g} ({time / fastest:.2f})"
                row.append(f"{text:>22}")
            out.append(" ".join(row).rstrip())
        out.append("")
        for solver, solved, failed, mean, share, seconds in summary(results, tolerance):
            out.append(f"  {solver:24} solved {solved:3}, failed {failed:3}, geometric mean of ratios "
                       f"{mean_text(mean)}, within twice the best {100 * share:.0f} %, all with failures at the "
                       f"limit {seconds:.3g} s")
        out.append("")
    return "\n".join(out)


PAGE = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Solvers of talus: performance profiles</title>
<style>
:root { color-scheme: light dark }
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem;
  background: #fff; color: #222 }
table { border-collapse: collapse; font-size: 13px; margin: .6rem 0 2rem } .wide { overflow-x: auto }
th, td { padding: .2rem .6rem; text-align: right; border-bottom: 1px solid #8884 }
th:first-child, td:first-child { text-align: left } td.best { font-weight: 700 } td.failed { color: #c0392b }
small { opacity: .7 } svg { max-width: 100%; height: auto }
@media (prefers-color-scheme: dark) { body { background: #15181c; color: #e8e8e8 } td.failed { color: #ff8a7a } }
</style>
"""


def cell(results, tolerance, problem, solver):
    if not results.applies(tolerance, problem, solver):
        return "<td></td>"
    time = results.time[tolerance, problem, solver]
    if time is None:
        return '<td class="failed">failed</td>'
    ratio = time / best(results, tolerance, problem)
    mark = ' class="best"' if ratio <= 1 else ""
    return f"<td{mark}>{text_of_time(time)} <small>×{ratio:.2f}</small></td>"


def table(head, rows):
    top = "".join(f"<th>{html.escape(h)}</th>" for h in head)
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def page(results):
    out = [PAGE, f"<h1>Performance profiles</h1><p>{html.escape(machine(results))}</p>", svg(results),
           "<p>A curve through (2, 80 %) says: on 80 % of the problems the solver needed at most twice the time of "
           "the fastest solver there. Left end: how often it is the fastest. Right end: how much it solves at all.</p>"]
    for tolerance in results.tolerances():
        out.append(f"<h2>Residual ≤ {tolerance}</h2>")
        rows = [f"<td>{html.escape(solver)}</td><td>{solved}</td><td>{failed}</td><td>{mean_text(mean)}</td>"
                f"<td>{100 * share:.0f} %</td><td>{seconds:.3g}</td>"
                for solver, solved, failed, mean, share, seconds in summary(results, tolerance)]
        out.append(table(["solver", "solved", "failed", "geometric mean of ratios", "within twice the best",
                          "all, failures at the limit [s]"], rows))
        rows = [f"<td>{html.escape(p)}</td><td>{results.contacts[p]}</td>"
                + "".join(cell(results, tolerance, p, s) for s in results.solvers()) for p in results.problems()]
        out.append("<p>Time of the solve [ms], and its ratio to the best</p>"
                   + table(["problem", "contacts", *results.solvers()], rows))
    return "\n".join(out) + "</html>\n"


KEPT = ["name", "run_type", "real_time", "time_unit", "solved", "residual", "residual_siconos", "own_tolerance",
        "contacts", "iterations", "label", "error_occurred", "error_message"]


def compact(report):
    """The report without what no script reads, numbers to five digits, a run per line."""
    def short(value):
        return float(f"{value:.5g}") if isinstance(value, float) else value
    context = {k: v for k, v in report.get("context", {}).items()
               if k not in ("executable", "load_avg", "caches", "host_name")}
    runs = [json.dumps({k: short(run[k]) for k in KEPT if k in run}) for run in report["benchmarks"]]
    return '{"context": ' + json.dumps(context) + ',\n"benchmarks": [\n' + ",\n".join(runs) + "\n]}\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("results", metavar="RESULTS.json", type=pathlib.Path)
    parser.add_argument("folder", metavar="FOLDER", type=pathlib.Path, help="where the files are written")
    parser.add_argument("--solvers", default="", help="regular expression: only those")
    parser.add_argument("--problems", default="", help="regular expression: only those")
    parser.add_argument("--store", action="store_true",
                        help="write the results themselves, shortened, instead of the page made of them")
    options = parser.parse_args()
    try:
        report = json.loads(options.results.read_text(encoding="utf-8"))
        results = Results.of(report)
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"profile.py: {options.results} is no result of bench_solvers: {error}", file=sys.stderr)
        return 2
    for key in list(results.time):
        if not re.search(options.solvers, key[2]) or not re.search(options.problems, key[1]):
            del results.time[key]
    if not results.time:
        print(f"profile.py: {options.results} holds no such run", file=sys.stderr)
        return 2
    options.folder.mkdir(parents=True, exist_ok=True)
    files = {"profile.svg": svg(results), "profile.txt": plain(results)}
    if options.store:
        files["results.json"] = compact(report)
    else:
        files["profile.html"] = page(results)
    for name, text in files.items():
        (options.folder / name).write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
