#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""usage: sample_report.py OUT.json [--large]    writes an invented report with everything a report may hold.

Passed, failed, broken off and not run; numbers missing; orders inside and outside their bands; curves with gaps;
strings that would break a careless page; a matrix with survivors. --large: about 150 rows and 3 MB.
"""
import json
import math
import random
import sys

HOSTILE = "</script><script>window.broken = 1</script><b>bold</b> & \"quotes\" | `ticks` <!-- \u2028 ]]>"
FAULTS = [
    ("friction_off", "Friction coefficient 2 % too large"),
    ("restitution_weight", "Restitution weight wrong"),
    ("begin_for_midpoint", "Midpoint replaced by begin point"),
    ("obstacle_forgotten", "Obstacle velocity forgotten"),
    ("gyroscopic_dropped", "Gyroscopic term dropped"),
    ("frame_bias", "Frame axis bias"),
    ("faceted_cone", "Faceted cone"),
    ("warm_start_shifted", "Warm start with the wrong contact"),
    ("stale_inertia", "Stale <i>inertia</i>"),
    ("residual_ignored", "Residual ignored"),
]
FAMILIES = {"A": "sliding_block", "B": "collisions", "C": "painleve", "D": "statics", "E": "smooth_motion"}


def check(label, tolerance_class, measured, expected, error, bound, h=None, unit="", note=""):
    passed = error is not None and bound is not None and abs(error) <= bound
    return {"label": label, "class": tolerance_class, "h": h, "measured": measured, "expected": expected,
            "error": error, "bound": bound, "unit": unit, "passed": passed, "note": note}


def statement(label, holds, note=""):
    return check(label, "S", None, None, 0 if holds else 1, 0, note=note)


def order_study(label, slope, band, constant, noise, generator):
    steps = [0.02 / 2**k for k in range(6)]
    errors = [constant * h**slope * math.exp(generator.gauss(0, noise)) for h in steps]
    x, y = [math.log(h) for h in steps], [math.log(e) for e in errors]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((a - mean_x)**2 for a in x)
    fitted = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / spread
    offset = mean_y - fitted * mean_x
    rest = sum((b - offset - fitted * a)**2 for a, b in zip(x, y))
    return {"label": label, "h": steps, "error": errors, "slope": fitted,
            "slope_error": 2.8 * math.sqrt(rest / (len(x) - 2) / spread),
            "constant": max(e / h**round(sum(band) / 2) for h, e in zip(steps, errors)),
            "band": list(band), "passed": band[0] <= fitted <= band[1]}


def drawing(dim, angle):
    """A block on an incline, as the harness might draw it."""
    c, s = math.cos(angle), math.sin(angle)
    block = " ".join(f"{80 + x * c + y * s:.1f},{110 - x * s + y * c:.1f}" for x, y in
                     ((40, 0), (80, 0), (80, -28), (40, -28)))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 140" font-family="sans-serif" font-size="11">'
            f'<line x1="20" y1="{110 + 60 * math.tan(angle):.1f}" x2="220" y2="{110 - 140 * math.tan(angle):.1f}" '
            f'stroke="#444" stroke-width="2"/><polygon points="{block}" fill="#9db8d2" stroke="#223"/>'
            f'<text x="24" y="20" fill="#222">{dim}D, incline {math.degrees(angle):.0f}°</text></svg>')


def oscillation(dim, generator, points):
    times = [4 * k / (points - 1) for k in range(points)]
    exact = [math.exp(-0.3 * t) * math.cos(2 * math.pi * t) for t in times]
    curves = [{"label": "position", "x_label": "t [s]", "y_label": "x [m]", "series": []},
              {"label": "speed over position", "x_label": "x [m]", "y_label": "v [m/s]", "series": []}]
    for h in (0.08, 0.02):
        coarse = times[::max(1, points // 50)]
        curves[0]["series"].append({"name": f"h = {h}", "x": coarse, "exact": False, "y": [
            math.exp(-0.3 * t) * math.cos(2 * math.pi * t * (1 + h / 8)) + generator.gauss(0, h / 40) for t in coarse]})
    curves[0]["series"][0]["y"][3] = None
    curves[0]["series"].append({"name": "exact", "x": times, "y": exact, "exact": True})
    loop = [2 * math.pi * k / 120 for k in range(121)]
    curves[1]["series"] = [
        {"name": "measured", "x": [1.01 * math.cos(a) for a in loop[::4]], "y": [6.2 * math.sin(a) for a in loop[::4]],
         "exact": False},
        {"name": "exact", "x": [math.cos(a) for a in loop], "y": [6.2832 * math.sin(a) for a in loop], "exact": True}]
    return curves


def result(dim, generator, tolerance_class, points, check_count):
    checks = []
    for number in range(check_count):
        expected = generator.uniform(-5, 5)
        bound = 1e-12 if tolerance_class == "R" else 1e-9 if tolerance_class == "S" else 2e-3
        error = 0.0 if generator.random() < 0.1 else bound * 10**generator.uniform(-5, -0.05) * generator.choice((1, -1))
        checks.append(check(f"quantity {number}", tolerance_class, expected + error, expected, error, bound,
                            h=generator.choice((None, 1e-2, 1e-4)), unit=generator.choice(("m/s", "m", ""))))
    checks.append(statement("statuses agree", True))
    orders = []
    if tolerance_class in ("D1", "D2"):
        degree = int(tolerance_class[1])
        orders = [order_study(name, degree, (degree - 0.1, degree + 0.1), 0.6, 0.01, generator)
                  for name in ("position", "velocity")]
    return {"dim": dim, "verdict": "passed", "seconds": round(generator.uniform(0.01, 4), 3), "budget": 5.0,
            "error": "", "drawing": drawing(dim, math.radians(generator.uniform(10, 35))), "checks": checks,
            "orders": orders, "curves": oscillation(dim, generator, points), "notes": []}


def case(number, section, generator, points, check_count):
    tolerance_class = generator.choice(("R", "S", "D1", "D2"))
    name = f"{FAMILIES[section].replace('_', '-')}-{number}"
    dims = generator.choice(([2, 3], [2, 3], [2, 3], [2], [3]))
    return {"id": f"{section}{number:02d}", "name": name, "title": f"Block number {number} of section {section}",
            "section": section, "family": FAMILIES[section], "gate": generator.choice((1, 1, 2, 3)), "dims": dims,
            "setup": "A block of mass 1 kg rests on a plane tilted by 20°. The coefficient of friction lies just below "
                     "the tangent of the angle, so that the block slides from the first step on. Gravity is 9.81 m/s².",
            "reference": ["v = g (sin β - μ cos β) t", "x = frac{1}{2} v t", "slides if and only if μ < tan β",
                          "ω_+ / ω_- = 1 - frac{3}{2} sin^2 α,   r = √{1 + frac{θ_0^2}{4}}"],
            "compared": "Position and velocity after every step.", "class": tolerance_class,
            "why": "The force is constant, so the scheme has no error of its own; what is left is rounding.",
            "source": "Coulomb 1781", "file": f"validation/{FAMILIES[section]}/{section}{number:02d}.cpp",
            "catches": [FAULTS[(number + k) % 9][0] for k in range(2)],
            "results": [result(dim, generator, tolerance_class, points, check_count) for dim in dims]}


def spoil(cases, generator):
    """Puts one of everything that can go wrong into the first cases."""
    for number in range(6):
        cases[number]["dims"] = [2, 3]
        cases[number]["results"] = [result(dim, generator, cases[number]["class"], 200, 6) for dim in (2, 3)]
    first, failing, broken, nulls, absent, dull = cases[:6]
    first |= {"title": "Block on an incline", "name": "incline-threshold", "class": "D1"}
    for one in first["results"]:
        one["orders"] = [order_study("position", 1, (0.9, 1.1), 0.58, 0.01, generator),
                         order_study("velocity", 1.04, (0.9, 1.1), 0.31, 0.02, generator)]
        one["notes"] = ["The last step before rest is left out of the fit: the block stops inside it."]
    failing["class"] = "D1, S"
    one = failing["results"][0]
    one["checks"].append(check("velocity at 1 s", "R", 1.25, 1.0, 0.25, 1e-12, h=0.01, unit="m/s", note="a real fault"))
    one["checks"].append(statement("statuses agree in every step", False, "slides in step 3"))
    one["checks"].append(check("barely outside", "S", 1.0 + 1.2e-9, 1.0, 1.2e-9, 1e-9))
    one["orders"] = [order_study("position", 0.62, (0.9, 1.1), 0.58, 0.05, generator),
                     order_study("velocity", 1.0, (0.9, 1.1), 0.58, 0.01, generator)]
    one["verdict"] = "failed"
    broken["results"][1] |= {"verdict": "error", "error": "the assembly refused a mass of -1 kg\n" + HOSTILE,
                             "checks": [], "orders": [], "curves": [], "drawing": ""}
    nulls["results"][0]["checks"] = [check("energy", "R", None, 1.0, None, 1e-12), check("no bound", "R", 1, 1, 0.0, None),
                                     check("exact", "R", 2.0, 2.0, 0.0, 0)]
    nulls["results"][0]["orders"] = [{"label": "position", "h": [0.1, 0.05, 0.025], "error": [None, 0.0, 1e-3],
                                      "slope": None, "slope_error": None, "constant": None, "band": [1.9, 2.1],
                                      "passed": False}]
    nulls["results"][0]["verdict"] = "failed"
    absent["results"] = []
    dull |= {"title": "Title with " + HOSTILE, "setup": HOSTILE, "reference": [HOSTILE, "x^{", "√", "frac{a}", "}_}"],
             "compared": HOSTILE, "why": HOSTILE, "source": HOSTILE, "catches": [HOSTILE]}
    dull["results"][0] |= {"notes": [HOSTILE], "curves": [{
        "label": HOSTILE, "x_label": HOSTILE, "y_label": HOSTILE, "series": [
            {"name": HOSTILE, "x": [0, 1, 2], "y": [1.0, 1.0, 1.0], "exact": False},
            {"name": "empty", "x": [], "y": [], "exact": True},
            {"name": "nothing finite", "x": [None], "y": [None], "exact": False}]}],
        "drawing": '<svg viewBox="0 0 10 10" onload="window.broken = 2"><script>window.broken = 3</script>'
                   '<image href="http://example.com/x.png"/><circle r="4" cx="5" cy="5"/></svg>'}
    dull["results"][0]["checks"][0] |= {"label": HOSTILE, "note": HOSTILE, "unit": "<m>"}
    dull["results"][1]["seconds"] = 7.5  # over its budget, which is no failure


def matrix(cases, generator):
    """Some of everything; residual_ignored survives, the second case is idle."""
    cells = []
    for number, one in enumerate(cases[:14]):
        for dim in one["dims"]:
            for fault, _ in FAULTS:
                claimed = fault in one["catches"]
                if not claimed and generator.random() < 0.5:
                    continue
                outcome = "caught" if claimed else generator.choice(("caught", "survived", "not run"))
                if fault == "residual_ignored" or number == 1:
                    outcome = "survived"
                if number == 7 and claimed:
                    outcome = "not run"
                cells.append({"case": one["id"], "dim": dim, "fault": fault, "claimed": claimed, "outcome": outcome,
                              "by": "velocity at 1 s" if outcome == "caught" else ""})
    return {"faults": [{"name": name, "title": title} for name, title in FAULTS], "cells": cells}


def summary(cases):
    results = [one for item in cases for one in item["results"]]
    passed = sum(one["verdict"] == "passed" for one in results)
    return {"cases": len(cases), "results": len(results), "passed": passed, "failed": len(results) - passed,
            "checks": sum(len(one["checks"]) for one in results),
            "seconds": round(sum(one["seconds"] for one in results), 3)}


def sample(large=False, sound=False, seed=1):
    """A report as a dictionary; sound: everything passed, no hostile strings, every fault caught."""
    generator = random.Random(seed)
    per_section, points, check_count = (18, 420, 20) if large else (5, 160, 6)
    cases = [case(number, section, generator, points, check_count)
             for section in "ABCDE" for number in range(1, per_section + 1)]
    if not sound:
        spoil(cases, generator)
    mutants = matrix(cases, generator)
    if sound:
        mutants["cells"] = [{"case": one["id"], "dim": dim, "fault": fault, "claimed": True, "outcome": "caught",
                             "by": "velocity at 1 s"}
                            for one in cases for dim in one["dims"] for fault, _ in FAULTS]
    environment = {"compiler": "g++ 12.2.0", "flags": "-O3 -DNDEBUG", "cpu": "an invented processor", "cores": 2,
                   "os": "Debian GNU/Linux 12", "eigen": "3.4.0", "gsl": "2.7.1", "commit": "abc1234"}
    if not sound:
        environment["remark"] = HOSTILE
    return {"schema": 1, "talus": "0.2.0", "created": "2026-11-22T20:30:00Z", "command": "validation/run --gate 2",
            "environment": environment,
            "options": {"gate": 2, "full": False, "filter": "", "dim": 0, "jobs": 2, "seed": seed},
            "summary": summary(cases), "cases": cases, "mutants": mutants}


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        json.dump(sample(large="--large" in sys.argv, sound="--sound" in sys.argv), file, ensure_ascii=False)
