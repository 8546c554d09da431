"""The evaluations' tables as a report of their own, and between the markers of a document.

A section is a pair of its name and its heading; body(name) gives its lines, none where it was not measured."""

import re
import sys


def write_report(path, title, sections, body):
    lines = [f"# {title}"]
    for name, heading in sections:
        section = body(name)
        if section:
            lines += ["", f"## {heading}", ""] + section
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def update_document(program, document, sections, body):
    """Puts sections between <!-- begin NAME --> and <!-- end NAME -->. Those that were not measured stay as they are."""
    text = document.read_text(encoding="utf-8")
    for name, _ in sections:
        begin, end = f"<!-- begin {name} -->\n", f"<!-- end {name} -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            sys.exit(f"{program}: error: {document} needs one {begin.strip()} and one {end} for what stands between them")
        section = body(name)
        if section:
            text = re.sub(re.escape(begin) + ".*?" + re.escape(end), lambda _, section=section: begin + "\n".join(section) + "\n" + end,
                          text, flags=re.DOTALL)
    document.write_text(text, encoding="utf-8")
