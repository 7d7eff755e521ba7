#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Draws how the residual falls with time on one problem of a run of bench_solvers, a curve per solver.

A point for every tolerance reached; the dotted end leads to the residual where the solver was stopped or gave up.
Run the bench with many tolerances: --tolerances 1e-2,3e-3,1e-3,3e-4,...
"""
import argparse
import html
import json
import math
import pathlib
import sys

from profile import COLOURS, STYLE, Results, line, machine

WIDTH, HEIGHT, LEFT, TOP = 560, 360, 80, 40


class Axes:
    """Time across and residual upwards, both logarithmic, from and to powers of ten."""

    def __init__(self, points):
        times, residuals = zip(*points)
        self.times = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))
        self.residuals = math.floor(math.log10(min(residuals))), math.ceil(math.log10(max(residuals)))

    @staticmethod
    def share(value, ends):
        return (math.log10(value) - ends[0]) / max(ends[1] - ends[0], 1)

    def at(self, point):
        x = LEFT + WIDTH * self.share(point[0], self.times)
        y = TOP + HEIGHT * (1 - self.share(point[1], self.residuals))
        return f"{x:.1f},{y:.1f}"

    def draw(self):
        out = []
        for k in range(self.times[0], self.times[1] + 1):
            x = LEFT + WIDTH * self.share(10.0 ** k, self.times)
            out.append(f'<path class="grid" d="M{x:.1f} {TOP}v{HEIGHT}"/><text class="soft" x="{x:.1f}" '
                       f'y="{TOP + HEIGHT + 16}" text-anchor="middle">{10.0 ** k:g}</text>')
        for k in range(self.residuals[0], self.residuals[1] + 1):
            y = TOP + HEIGHT * (1 - self.share(10.0 ** k, self.residuals))
            out.append(f'<path class="grid" d="M{LEFT} {y:.1f}h{WIDTH}"/><text class="soft" x="{LEFT - 6}" '
                       f'y="{y + 4:.1f}" text-anchor="end">1e{k}</text>')
        return out + [f'<rect class="frame" x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}"/>',
                      f'<text class="ink" x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 34}" text-anchor="middle">'
                      'CPU time [s]</text>',
                      f'<text class="ink" transform="translate({LEFT - 52} {TOP + HEIGHT / 2}) rotate(-90)" '
                      'text-anchor="middle">residual</text>']


def curves(results, problem):
    """For every solver the points (time, residual) it arrived at, and where it ended, or None."""
    found = {}
    for solver in results.solvers():
        reached, end = [], None
        for tolerance in results.tolerances():
            key = tolerance, problem, solver
            if key not in results.time:
                continue
            if results.time[key] is None:
                residual = results.residual[key]
                if end is None and isinstance(residual, (int, float)) and 0.0 < residual < 1.0:
                    end = results.spent[key], residual
            else:
                reached.append((results.time[key], float(tolerance)))
        if reached or end:
            found[solver] = reached, end
    return found


def best_first(found):
    """The solvers by the smallest residual they came to."""
    def lowest(solver):
        reached, end = found[solver]
        return min(residual for _, residual in reached + ([end] if end else []))
    return sorted(found, key=lowest)


def svg(results, problem):
    found = curves(results, problem)
    axes = Axes([p for reached, end in found.values() for p in reached + ([end] if end else [])])
    high = TOP + HEIGHT + 50
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 220} {high}" '
           f'width="{LEFT + WIDTH + 220}" height="{high}" role="img" aria-label="Residual over time">'
           f'<style>{STYLE}</style><rect class="ground" width="100%" height="100%"/>'
           f'<text class="ink title" x="{LEFT}" y="{TOP - 20}">{html.escape(problem)}</text>'
           f'<text class="soft" x="{LEFT}" y="{TOP - 5}">{html.escape(machine(results))}</text>', *axes.draw()]
    for k, solver in enumerate(best_first(found)):
        reached, end = found[solver]
        style = line(k % len(COLOURS)) if k < len(COLOURS) else line(k % len(COLOURS)) + ' opacity="0.55"'
        if reached:
            points = " ".join(axes.at(p) for p in reached)
            out.append(f'<polyline points="{points}" {style}><title>{html.escape(solver)}</title></polyline>')
        if end:
            start = axes.at(reached[-1]) if reached else axes.at(end)
            out.append(f'<path d="M{start}L{axes.at(end)}" fill="none" stroke="{COLOURS[k % len(COLOURS)]}" '
                       'stroke-width="1.2" stroke-dasharray="1 3"/>')
        y = TOP + 14 + 20 * k
        out.append(f'<path d="M{LEFT + WIDTH + 14} {y}h30" {style}/><text class="ink" x="{LEFT + WIDTH + 50}" '
                   f'y="{y + 4}">{html.escape(solver)}</text>')
    return "\n".join(out + ["</svg>\n"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("results", metavar="RESULTS.json", type=pathlib.Path)
    parser.add_argument("problem", metavar="PROBLEM")
    parser.add_argument("out", metavar="OUT.svg", type=pathlib.Path)
    options = parser.parse_args()
    try:
        results = Results.of(json.loads(options.results.read_text(encoding="utf-8")))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        print(f"curves.py: {options.results} is no result of bench_solvers: {error}", file=sys.stderr)
        return 2
    if options.problem not in results.problems():
        print(f"curves.py: {options.results} holds no run of '{options.problem}', but of: "
              f"{', '.join(results.problems())}", file=sys.stderr)
        return 2
    options.out.write_text(svg(results, options.problem), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
