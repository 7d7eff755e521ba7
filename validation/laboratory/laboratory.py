#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Runs the experiments of examples/ for several seeds, and adds to a report what the catalogue of cases asks of them.

What is run, and what is asked, stands in cases.json (README.md says how). An experiment writes what it found to findings.csv.
Exit code 0 only if all that ran passed; 2 for what is wrong.
"""
import argparse
import concurrent.futures
import csv
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
# Steps of a run that may miss the tolerance: the averages of thousands of steps do not see one in a thousand.
MOST_MISSED = 1e-3


class LaboratoryError(Exception):
    pass


def read_cases(path=HERE / "cases.json"):
    try:
        cases = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise LaboratoryError(f"{path} cannot be read: {error}") from None
    for case in cases:
        for dim, trial in case["dims"].items():
            where = f"{case['id']} in {dim}D"
            for check in trial["checks"]:
                kinds = [kind for kind in ("expected", "at_least", "at_most", "pooled_at_least") if kind in check]
                if len(kinds) != 1:
                    raise LaboratoryError(f"{where}: check of '{check['finding']}' asks {kinds}, but must ask one thing")
                if ("expected" in check) != ("bound" in check):
                    raise LaboratoryError(f"{where}: check of '{check['finding']}' needs 'expected' and 'bound' together")
                for run in (check.get("of", "main"), check.get("less", "main")):
                    if run not in trial["runs"]:
                        raise LaboratoryError(f"{where}: check of '{check['finding']}' is of run '{run}', which is not there")
    return cases


def chosen(cases, pattern, dim):
    """(case, dim) whose id, name or family matches, as validation/run --filter does."""
    for case in cases:
        if pattern and not re.search(pattern, f"{case['id']} {case['name']} laboratory", re.IGNORECASE):
            continue
        for d in sorted(case["dims"], key=int):
            if dim in (None, int(d)):
                yield case, int(d)


def findings_of(folder):
    with open(folder / "findings.csv", newline="") as file:
        return {row["finding"]: (float(row["value"]), row["unit"]) for row in csv.DictReader(file)}


def missed_of(printed):
    """Share of the steps that missed the tolerance, from the last certificate."""
    lines = re.findall(r"certified: (\d+) steps, (\d+) missed", printed)
    return int(lines[-1][1]) / max(int(lines[-1][0]), 1) if lines else math.nan


class Runs:
    """Experiments that were run, each once for the same options and seed, whatever cases ask of it."""

    def __init__(self, programs, work, jobs):
        self.programs, self.work = pathlib.Path(programs), pathlib.Path(work)
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)
        self.begun = {}

    def begin(self, run, seed):
        key = (run["experiment"], *run.get("options", []), seed)
        if key not in self.begun:
            self.begun[key] = self.pool.submit(self.perform, run, seed, f"{run['experiment']}-{len(self.begun)}")
        return self.begun[key]

    def perform(self, run, seed, name):
        program, out = self.programs / run["experiment"], self.work / name
        if not program.exists():
            raise LaboratoryError(f"{program} is missing, but must be built")
        begin = time.monotonic()
        done = subprocess.run([str(program), *run.get("options", []), "--seed", str(seed), "--out", str(out), "--quiet", "--fresh"],
                              capture_output=True, text=True)
        # 3: some step missed the tolerance, which a check is about.
        if done.returncode not in (0, 3):
            last = (done.stderr.strip() or "no word").splitlines()[-1]
            raise LaboratoryError(f"{run['experiment']} with seed {seed} ended with {done.returncode}: {last}")
        return {"findings": findings_of(out), "missed": missed_of(done.stdout), "seconds": time.monotonic() - begin, "folder": out}


def mean_and_error(values):
    if not all(map(math.isfinite, values)):
        return math.nan, math.nan
    mean = statistics.fmean(values)
    return mean, statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def number(x):
    """JSON has no infinities."""
    return x if math.isfinite(x) else None


def check_of(label, kind, measured, expected, error, bound, unit, note):
    # (One-sided errors are made by min and max, which a nan gets past.)
    error = error if math.isfinite(measured) else math.nan
    passed = math.isfinite(error) and abs(error) <= bound
    return {"label": label, "class": kind, "h": None, "measured": number(measured), "expected": number(expected),
            "error": number(error), "bound": number(bound), "unit": unit, "passed": passed, "note": note}


def judged(check, values, unit):
    """A check over the values of all seeds."""
    mean, error = mean_and_error(values)
    said = f"mean of {len(values)} seeds, standard error {error:.2g}; " + check.get("note", "")
    label = check.get("label", check["finding"])
    if "expected" in check:
        return check_of(label, "T", mean, check["expected"], mean - check["expected"], check["bound"], unit, said)
    if "pooled_at_least" in check:
        # Of numbers that are in units of their own standard errors.
        pooled, least = sum(values) / math.sqrt(len(values)), check["pooled_at_least"]
        return check_of(label, "X", pooled, least, min(0.0, pooled - least), 0.0, unit,
                        f"{len(values)} seeds together; at least; " + check.get("note", ""))
    if "at_least" in check:
        return check_of(label, "E", mean, check["at_least"], min(0.0, mean - check["at_least"]), 0.0, unit, "at least; " + said)
    return check_of(label, "E", mean, check["at_most"], max(0.0, mean - check["at_most"]), 0.0, unit, "at most; " + said)


def try_case(trial, runs, seeds):
    """The result of a case in one dimension, as in report.json."""
    result = {"dim": None, "verdict": "error", "seconds": 0.0, "budget": None, "error": "", "drawing": "", "checks": [],
              "orders": [], "curves": [], "notes": []}
    begun = {name: [runs.begin(run, seed) for seed in seeds] for name, run in trial["runs"].items()}
    try:
        done = {name: [job.result() for job in jobs] for name, jobs in begun.items()}
    except (LaboratoryError, OSError, ValueError, KeyError) as error:
        result["error"] = str(error)
        return result
    for name, all_runs in done.items():
        result["seconds"] += sum(run["seconds"] for run in all_runs)
        missed = max((run["missed"] for run in all_runs), key=lambda x: math.inf if math.isnan(x) else x)
        result["checks"].append(check_of(f"steps that missed the tolerance, {trial['runs'][name]['experiment']}", "T", missed, 0.0,
                                         missed, MOST_MISSED, "of all steps", "worst seed"))
        command = " ".join([trial["runs"][name]["experiment"], *trial["runs"][name].get("options", [])])
        result["notes"].append(f"examples/run {command} --seed {seeds[0]} to {seeds[-1]}")
    for check in trial["checks"]:
        finding = check["finding"]
        try:
            values = [run["findings"][finding][0] for run in done[check.get("of", "main")]]
            unit = done[check.get("of", "main")][0]["findings"][finding][1]
            if "less" in check:
                values = [x - run["findings"][finding][0] for x, run in zip(values, done[check["less"]])]
        except KeyError:
            result["error"] = f"'{finding}' is not among the findings"
            return result
        result["checks"].append(judged(check, values, unit))
        result["curves"].append({"label": check.get("label", finding), "x_label": "seed", "y_label": f"{finding} [{unit}]",
                                 "series": [{"name": "found", "x": list(seeds), "y": [number(x) for x in values], "exact": False},
                                            *reference(check, seeds)]})
    picture = done["main"][0]["folder"] / trial.get("drawing", "none")
    if picture.exists():
        result["drawing"] = picture.read_text()
    result["verdict"] = "passed" if all(check["passed"] for check in result["checks"]) else "failed"
    return result


def reference(check, seeds):
    """What the values are held against, as curves."""
    ends = [seeds[0], seeds[-1]]
    if "expected" in check:
        return [{"name": name, "x": ends, "y": [y, y], "exact": True} for name, y in
                (("lowest", check["expected"] - check["bound"]), ("highest", check["expected"] + check["bound"]))]
    return [{"name": kind.replace("_", " "), "x": ends, "y": [check[kind]] * 2, "exact": True}
            for kind in ("at_least", "at_most") if kind in check]


def report_case(case):
    """The case without its results, as in report.json."""
    kept = {key: case[key] for key in ("id", "name", "title", "setup", "reference", "compared", "class", "why", "source")}
    return {**kept, "section": case["id"][0], "family": "laboratory", "gate": 3, "dims": sorted(map(int, case["dims"])),
            "file": "validation/laboratory/cases.json", "catches": [], "results": []}


def add_to(report, case, result):
    """Puts a result into a report, where cases stand by their ids."""
    cases = report["cases"]
    there = next((c for c in cases if c["id"] == case["id"]), None)
    if there is None:
        there = report_case(case)
        cases.append(there)
        cases.sort(key=lambda c: c["id"])
    there["results"].append(result)
    summary = report["summary"]
    summary["cases"] = len(cases)
    summary["results"] += 1
    summary["passed" if result["verdict"] == "passed" else "failed"] += 1
    summary["checks"] += len(result["checks"])
    summary["seconds"] += result["seconds"]


def write(report, path):
    """Whole or not at all."""
    with tempfile.NamedTemporaryFile("w", dir=path.parent, delete=False, suffix=".json") as file:
        json.dump(report, file, indent=1)
        file.write("\n")
    pathlib.Path(file.name).chmod(0o644)
    pathlib.Path(file.name).replace(path)


def run(options, jobs):
    path = pathlib.Path(options.report)
    try:
        report = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise LaboratoryError(f"{path} cannot be read: {error}") from None
    seeds = range(options.seed, options.seed + options.seeds)
    failed = 0
    work = pathlib.Path(options.work or tempfile.mkdtemp(prefix="talus-laboratory-"))
    try:
        runs = Runs(options.programs, work, options.jobs)
        for case, dim in jobs:  # so that all of them wait in line
            for one in case["dims"][str(dim)]["runs"].values():
                for seed in seeds:
                    runs.begin(one, seed)
        for case, dim in jobs:
            result = try_case(case["dims"][str(dim)], runs, list(seeds))
            result["dim"] = dim
            failed += result["verdict"] != "passed"
            print(f"{case['id']} {dim}D {result['verdict']:7} {result['seconds']:7.0f} s  {case['title']}", flush=True)
            if result["error"]:
                print(f"    {result['error']}")
            for check in result["checks"]:
                if not check["passed"]:
                    print(f"    {check['label']}: {check['measured']}, {check['expected']} expected ({check['note']})")
            add_to(report, case, result)
            write(report, path)  # at once: what follows may be stopped
    finally:
        if not options.work:
            shutil.rmtree(work, ignore_errors=True)
    return 1 if failed else 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", nargs="?", help="report.json, to which the results are added")
    parser.add_argument("--programs", default=str(ROOT / "build/examples/examples"), help="where the experiments are built")
    parser.add_argument("--filter", help="only cases whose id, name or family matches")
    parser.add_argument("--dim", type=int, choices=(2, 3), help="only this dimension")
    parser.add_argument("--seed", type=int, default=1, help="the first (1)")
    parser.add_argument("--seeds", type=int, default=5, help="how many (5)")
    parser.add_argument("--jobs", type=int, default=1, help="experiments at a time (1)")
    parser.add_argument("--work", help="folder for what the experiments write, kept; by default one that is taken away")
    parser.add_argument("--list", action="store_true", help="list the cases and stop")
    parser.add_argument("--experiments", action="store_true", help="name the experiments that are run, and stop")
    options = parser.parse_args(arguments)
    try:
        if options.seeds < 1:
            raise LaboratoryError(f"--seeds is {options.seeds}, but must be at least 1")
        jobs = list(chosen(read_cases(), options.filter, options.dim))
        if options.experiments:
            print(" ".join(sorted({one["experiment"] for case, dim in jobs for one in case["dims"][str(dim)]["runs"].values()})))
            return 0
        if options.list:
            for case, dim in jobs:
                print(f"{case['id']} {dim}D gate 3  {case['title']} (laboratory)")
            return 0
        if not options.report:
            raise LaboratoryError("no report is given, but must be: that of validation/run")
        return run(options, jobs)
    except (LaboratoryError, re.error) as error:
        print(f"laboratory.py: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
