# SPDX-License-Identifier: BSL-1.0
"""Reading report.json: its schema, the numbers derived from it, and what in it contradicts itself.

The page computes the same derived numbers again in JavaScript; tests/validation compares both.
"""
import json
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Titles of the sections of the catalogue of cases.
SECTIONS = {
    "A": "Single contact with friction",
    "B": "Collisions",
    "C": "Painlevé situations and frictional catastrophes",
    "D": "Statics in one step from rest",
    "E": "Smooth motion and loss of contact",
    "F": "Lagrangian systems with few degrees of freedom",
    "G": "Granular assemblies",
    "K": "Cohesion",
    "U": "A case of your own",
}

VERDICTS = ("passed", "failed", "error", "not run")  # the last one is that of a case without a result
OUTCOMES = ("caught", "survived", "not run")

_TEXT, _FLAG, _WHOLE = (str,), (bool,), (int,)
_NUMBER = (int, float)
_NUMBER_OR_NONE = (int, float, type(None))  # a number that was not finite is null

_CHECK = {"label": _TEXT, "class": _TEXT, "h": _NUMBER_OR_NONE, "measured": _NUMBER_OR_NONE,
          "expected": _NUMBER_OR_NONE, "error": _NUMBER_OR_NONE, "bound": _NUMBER_OR_NONE,
          "unit": _TEXT, "passed": _FLAG, "note": _TEXT}
_ORDER = {"label": _TEXT, "h": [_NUMBER_OR_NONE], "error": [_NUMBER_OR_NONE], "slope": _NUMBER_OR_NONE,
          "slope_error": _NUMBER_OR_NONE, "constant": _NUMBER_OR_NONE, "band": [_NUMBER], "passed": _FLAG}
_CURVE = {"label": _TEXT, "x_label": _TEXT, "y_label": _TEXT,
          "series": [{"name": _TEXT, "x": [_NUMBER_OR_NONE], "y": [_NUMBER_OR_NONE], "exact": _FLAG}]}
_RESULT = {"dim": _WHOLE, "verdict": _TEXT, "seconds": _NUMBER, "budget": _NUMBER_OR_NONE, "error": _TEXT,
           "drawing": _TEXT, "checks": [_CHECK], "orders": [_ORDER], "curves": [_CURVE], "notes": [_TEXT]}
_CASE = {"id": _TEXT, "name": _TEXT, "title": _TEXT, "section": _TEXT, "family": _TEXT, "gate": _WHOLE,
         "dims": [_WHOLE], "setup": _TEXT, "reference": [_TEXT], "compared": _TEXT, "class": _TEXT,
         "why": _TEXT, "source": _TEXT, "file": _TEXT, "catches": [_TEXT], "results": [_RESULT]}
_REPORT = {"schema": _WHOLE, "talus": _TEXT, "created": _TEXT, "command": _TEXT, "environment": {},
           "options": {}, "summary": {"cases": _WHOLE, "results": _WHOLE, "passed": _WHOLE, "failed": _WHOLE,
                                      "checks": _WHOLE, "seconds": _NUMBER}, "cases": [_CASE]}
_MUTANTS = {"faults": [{"name": _TEXT, "title": _TEXT}],
            "cells": [{"case": _TEXT, "dim": _WHOLE, "fault": _TEXT, "claimed": _FLAG, "outcome": _TEXT,
                       "by": _TEXT}]}


class ReportError(Exception):
    """A file that is not a report; the message names the item."""


def _require(value, shape, where):
    if isinstance(shape, dict):
        if not isinstance(value, dict):
            raise ReportError(f"{where} is not an object")
        for key, inner in shape.items():
            if key not in value:
                raise ReportError(f"{where} has no '{key}'")
            _require(value[key], inner, f"{where}.{key}")
    elif isinstance(shape, list):
        if not isinstance(value, list):
            raise ReportError(f"{where} is not a list")
        for number, item in enumerate(value):
            _require(item, shape[0], f"{where}[{number}]")
    elif not isinstance(value, shape) or (isinstance(value, bool) and bool not in shape):
        kinds = " or ".join("null" if kind is type(None) else kind.__name__ for kind in shape)
        raise ReportError(f"{where} is {value!r}, which is not {kinds}")


def _require_form(case, result):
    """What the shape alone cannot say."""
    where = f"{case['id']} in {result['dim']}D"
    if result["verdict"] not in VERDICTS[:3]:
        raise ReportError(f"{where}: unknown verdict '{result['verdict']}'")
    for order in result["orders"]:
        if len(order["band"]) != 2 or len(order["h"]) != len(order["error"]):
            raise ReportError(f"{where}: order study '{order['label']}' has lists of wrong length")
    for curve in result["curves"]:
        for series in curve["series"]:
            if len(series["x"]) != len(series["y"]):
                raise ReportError(f"{where}: curve '{curve['label']}' has lists of different length")


def _require_mutants(mutants, where):
    _require(mutants, _MUTANTS, where)
    for cell in mutants["cells"]:
        if cell["outcome"] not in OUTCOMES:
            raise ReportError(f"{where}: unknown outcome '{cell['outcome']}' of {cell['case']} with {cell['fault']}")


def _read_json(path):
    def refuse(name):
        raise ReportError(f"{path}: {name} is not a number of JSON; what is not finite is null")
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"), parse_constant=refuse)
    except OSError as problem:
        raise ReportError(f"{path} cannot be read: {problem.strerror}") from problem
    except ValueError as problem:
        raise ReportError(f"{path} is not JSON: {problem}") from problem


def load(path):
    """The report in `path`; ReportError when it does not have the form of schema 1."""
    report = _read_json(path)
    if not isinstance(report, dict) or report.get("schema") != 1:
        raise ReportError(f"{path} is not a report of schema 1")
    _require(report, _REPORT, "report")
    for case, result in rows(report):
        if result is not None:
            _require_form(case, result)
    if report.get("mutants") is not None:
        _require_mutants(report["mutants"], "report.mutants")
    return report


def load_mutants(path):
    """The matrix in `path`, which is either a report or the matrix alone."""
    content = _read_json(path)
    mutants = content.get("mutants", content) if isinstance(content, dict) else None
    _require_mutants(mutants, "mutants")
    return mutants


def rows(report):
    """(case, result) in the order of the report; result is None for a case of which nothing ran."""
    for case in report["cases"]:
        for result in case["results"] or [None]:
            yield case, result


def verdict(result):
    return "not run" if result is None else result["verdict"]


def ratio(check):
    """|error| / bound; infinite where there is no number, or an error although none is allowed."""
    if check["error"] is None or check["bound"] is None:
        return math.inf
    error = abs(check["error"])
    if check["bound"] > 0:
        return error / check["bound"]
    return 0.0 if error == 0 else math.inf


def worst_ratio(result):
    """Largest error / bound of the checks, None where there is no check."""
    return max(map(ratio, result["checks"]), default=None) if result else None


def off_centre(order):
    """Distance of the slope from the middle of its band in half widths: 1 on the edge, infinite without slope."""
    low, high = order["band"]
    if order["slope"] is None:
        return math.inf
    distance = abs(order["slope"] - (low + high) / 2)
    return distance / ((high - low) / 2) if high > low else (0.0 if distance == 0 else math.inf)


def worst_order(result):
    """The order study closest to leaving its band or farthest outside (the first of equals), None without any."""
    return max(result["orders"], key=off_centre, default=None) if result else None


def contradictions(report):
    """Sentences on what cannot all be true in the report, empty for a sound one."""
    found, seen = [], set()
    counts = {"passed": 0, "failed": 0, "results": 0, "checks": 0, "orders": 0}
    for case, result in rows(report):
        if result is None:
            continue
        where = f"{case['id']} in {result['dim']}D"
        if (case["id"], result["dim"]) in seen:
            found.append(f"{where} is there twice")
        seen.add((case["id"], result["dim"]))
        if result["dim"] not in case["dims"]:
            found.append(f"{where} is not among the dimensions of the case")
        for check in result["checks"]:
            if check["passed"] != (ratio(check) <= 1):
                said = "passed" if check["passed"] else "failed"
                found.append(f"{where}: check '{check['label']}' is called {said}, "
                             f"but error / bound = {ratio(check):.3g}")
        for order in result["orders"]:
            inside = order["slope"] is not None and order["band"][0] <= order["slope"] <= order["band"][1]
            if order["passed"] != inside:
                said = "passed" if order["passed"] else "failed"
                found.append(f"{where}: order study '{order['label']}' is called {said}, "
                             f"but its slope is {'inside' if inside else 'outside'} its band")
        parts = result["checks"] + result["orders"]
        if result["verdict"] == "passed" and not parts:
            found.append(f"{where} is called passed without a check")
        all_passed = all(part["passed"] for part in parts) and not result["error"]
        if (result["verdict"] == "passed") != all_passed and parts:
            found.append(f"{where} is called {result['verdict']}, but "
                         + ("everything in it passed" if all_passed else "not everything in it passed"))
        counts["results"] += 1
        counts["passed" if result["verdict"] == "passed" else "failed"] += 1
        counts["checks"] += len(result["checks"])
        counts["orders"] += len(result["orders"])
    summary = report["summary"]
    for key in ("passed", "failed", "results"):
        if summary[key] != counts[key]:
            found.append(f"the summary counts {summary[key]} {key}, the cases hold {counts[key]}")
    if summary["cases"] != len(report["cases"]):
        found.append(f"the summary counts {summary['cases']} cases, there are {len(report['cases'])}")
    if summary["checks"] not in (counts["checks"], counts["checks"] + counts["orders"]):
        found.append(f"the summary counts {summary['checks']} checks, the cases hold {counts['checks']}")
    if report.get("mutants"):
        found += mutant_contradictions(report["mutants"])
    return found


def mutant_contradictions(mutants):
    names = {fault["name"] for fault in mutants["faults"]}
    return [f"the matrix has a cell of fault '{name}', which is not in its list"
            for name in sorted({cell["fault"] for cell in mutants["cells"]} - names)]


def mutant_findings(mutants):
    """What the matrix says against the harness: faults nobody catches, cases that catch nothing, broken claims."""
    caught = [cell for cell in mutants["cells"] if cell["outcome"] == "caught"]
    caught_faults = {cell["fault"] for cell in caught}
    useful_cases = {cell["case"] for cell in caught}
    return {
        "survivors": [fault["name"] for fault in mutants["faults"] if fault["name"] not in caught_faults],
        "idle": sorted({cell["case"] for cell in mutants["cells"]} - useful_cases),
        "broken": [cell for cell in mutants["cells"] if cell["claimed"] and cell["outcome"] == "survived"],
        "untried": [cell for cell in mutants["cells"] if cell["claimed"] and cell["outcome"] == "not run"],
    }


def command_line(main):
    """Runs main(); a report that cannot be used ends with one sentence and status 2."""
    try:
        sys.exit(main())
    except (ReportError, OSError) as problem:
        print(f"{pathlib.Path(sys.argv[0]).name}: {problem}", file=sys.stderr)
        sys.exit(2)


def complain(report):
    """Prints the contradictions of the report; the exit status to end with."""
    found = contradictions(report)
    for sentence in found:
        print(f"the report contradicts itself: {sentence}", file=sys.stderr)
    return 1 if found else 0
