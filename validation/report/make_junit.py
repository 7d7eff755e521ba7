#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes a validation run as JUnit XML: a suite per section, a test per case and dimension.

Exit status: 0, 1 when the report contradicts itself, 2 when it cannot be used.
"""
import argparse
import re
import xml.etree.ElementTree as xml

import report_file

# What XML 1.0 cannot hold, not even escaped.
FORBIDDEN = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def clean(text):
    return FORBIDDEN.sub("\ufffd", text)


def number(value):
    return "not finite" if value is None else f"{value:.6g}"


def describe_check(check):
    line = f"check '{check['label']}' [{check['class']}]"
    if check["h"] is not None:
        line += f" at h = {number(check['h'])}"
    if check["measured"] is not None or check["expected"] is not None:
        unit = f" {check['unit']}" if check["unit"] else ""
        line += f": measured {number(check['measured'])}{unit}, expected {number(check['expected'])}{unit}"
    line += f": error {number(check['error'])}, bound {number(check['bound'])}"
    return line + (f" ({check['note']})" if check["note"] else "")


def describe_order(order):
    low, high = order["band"]
    return f"order of '{order['label']}': {number(order['slope'])} is not in [{low:g}, {high:g}]"


def failures(result):
    lines = [describe_check(check) for check in result["checks"] if not check["passed"]]
    lines += [describe_order(order) for order in result["orders"] if not order["passed"]]
    if result["error"]:
        lines.append(result["error"])
    return lines or [f"verdict: {result['verdict']}"]


def test_case(case, result):
    where = f" {result['dim']}D" if result else ""
    element = xml.Element("testcase", {
        "classname": clean(f"validation.{case['section']}.{case['family']}"),
        "name": clean(f"{case['id']} {case['name']}{where}"), "file": clean(case["file"]),
        "time": f"{result['seconds'] if result else 0:.3f}"})
    if result is None:
        xml.SubElement(element, "skipped", message="not run")
    elif result["verdict"] != "passed":
        lines = failures(result)
        message = lines[0] if len(lines) == 1 else f"{len(lines)} failures, first: {lines[0]}"
        tag = "error" if result["verdict"] == "error" else "failure"
        xml.SubElement(element, tag, message=clean(message)).text = clean("\n".join(lines))
    return element


def document(report):
    root = xml.Element("testsuites", name="talus validation")
    suites = {}
    for case, result in report_file.rows(report):
        suites.setdefault(case["section"], []).append((case, result))
    whole = dict.fromkeys(("tests", "failures", "errors", "skipped"), 0) | {"time": 0.0}
    for section in sorted(suites):
        members = suites[section]
        verdicts = [report_file.verdict(result) for _, result in members]
        counts = {"tests": len(members), "failures": verdicts.count("failed"),
                  "errors": verdicts.count("error"), "skipped": verdicts.count("not run"),
                  "time": sum(result["seconds"] for _, result in members if result)}
        title = report_file.SECTIONS.get(section)
        suite = xml.SubElement(root, "testsuite", {
            "name": clean(f"{section} {title}" if title else section),
            "timestamp": clean(report["created"].removesuffix("Z"))})
        for key, value in counts.items():
            whole[key] += value
            suite.set(key, f"{value:.3f}" if key == "time" else str(value))
        properties = xml.SubElement(suite, "properties")
        for name, value in {"talus": report["talus"], "command": report["command"],
                            **report["environment"]}.items():
            xml.SubElement(properties, "property", name=clean(name), value=clean(str(value)))
        suite.extend(test_case(case, result) for case, result in members)
    for key, value in whole.items():
        root.set(key, f"{value:.3f}" if key == "time" else str(value))
    xml.indent(root)
    return xml.ElementTree(root)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("report", metavar="REPORT.json")
    parser.add_argument("xml", metavar="OUT.xml")
    options = parser.parse_args()
    report = report_file.load(options.report)
    status = report_file.complain(report)
    document(report).write(options.xml, encoding="utf-8", xml_declaration=True)
    return status


if __name__ == "__main__":
    report_file.command_line(main)
