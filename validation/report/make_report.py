#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Writes the page of a validation run: one HTML file that needs neither network nor other files.

Exit status: 0, 1 when the report contradicts itself (the page says so at its top), 2 when it cannot be used.
"""
import argparse
import json
import pathlib

import report_file

TEMPLATE = pathlib.Path(__file__).with_name("template.html")
MARK = "@REPORT@"


def embedded(value):
    """JSON that cannot end the script element it stands in, nor open a comment there."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def page(report):
    before, after = TEMPLATE.read_text(encoding="utf-8").split(MARK)
    data = {"report": report, "sections": report_file.SECTIONS,
            "contradictions": report_file.contradictions(report)}
    return before + embedded(data) + after


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("report", metavar="REPORT.json")
    parser.add_argument("html", metavar="OUT.html", type=pathlib.Path)
    options = parser.parse_args()
    report = report_file.load(options.report)
    text = page(report)
    # A lone surrogate is legal in JSON and cannot be written as UTF-8.
    options.html.write_text(text, encoding="utf-8", errors="replace")
    return report_file.complain(report)


if __name__ == "__main__":
    report_file.command_line(main)
