#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lists the named constants of source folders as a Markdown table: file, name, value, meaning and reason.

Usage: python3 tests/list_constants.py FOLDER...     such as lib/balance lib/explain
"""
import pathlib
import re
import sys

DECLARATION = re.compile(r"constexpr\s+(?:[\w:<>, ]+?)\s(k[A-Z]\w*)\s*(?:=\s*|(?=\{))(.*)")


def text_of(line):
    """The comment of a line, without its marks."""
    found = re.search(r"//[/!]?<?\s?(.*)", line)
    return found.group(1).strip() if found else ""


def constants(path):
    """Name, value and meaning of each constant of a file."""
    lines = path.read_text().splitlines()
    for at, line in enumerate(lines):
        found = DECLARATION.search(line)
        if not found or line.lstrip().startswith("//"):
            continue
        last = at
        while ";" not in lines[last].split("//")[0] and last + 1 < len(lines):
            last += 1
        code = " ".join(part.split("//")[0].strip() for part in lines[at:last + 1])
        value = re.sub(r"^.*?" + found.group(1) + r"\s*=?\s*", "", code).rstrip("; ")
        said = " ".join(filter(None, (text_of(part) for part in lines[at:last + 1])))
        above = []
        while at - 1 - len(above) >= 0 and lines[at - 1 - len(above)].lstrip().startswith("//"):
            above.insert(0, text_of(lines[at - 1 - len(above)]))
        yield found.group(1), value, said or " ".join(above)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("| file | constant | value | meaning and reason |\n|---|---|---|---|")
    for folder in sys.argv[1:]:
        for path in sorted(pathlib.Path(folder).rglob("*.?pp")):
            for name, value, said in constants(path):
                print(f"| {path} | `{name}` | `{value}` | {said} |".replace("||", "| |"))


if __name__ == "__main__":
    main()
