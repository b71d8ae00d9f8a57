#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks documents against the JSON Schemas of docs/schemas, and that a member too many does not pass.

Usage: check_schema.py SCHEMAS NAME=FILE...     NAME such as diagnosis-1; of .ndjson each line is a document
Prints what is wrong, and `open NAME PATH` for each object that takes any member. Exit status 0: all documents
are valid, 1: not all, 77: python3-jsonschema is missing.
"""
import copy
import json
import pathlib
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("python3-jsonschema is missing")
    sys.exit(77)


def objects(document, path=""):
    """Each kind of object once: the path of members that leads there, [] for any item of a list."""
    if isinstance(document, dict):
        yield path, document
        for name, member in document.items():
            yield from objects(member, f"{path}.{name}")
    elif isinstance(document, list):
        for item in document:
            yield from objects(item, f"{path}[]")


def open_objects(validator, document):
    """Paths of objects that a member too many does not make invalid."""
    document = copy.deepcopy(document)
    seen = set()
    for path, found in list(objects(document)):
        if path in seen:
            continue
        seen.add(path)
        found["no_member_of_ours"] = {"value": 0, "std": 0} if path.endswith((".condition", ".parameters")) else 0
        if validator.is_valid(document):
            yield path
        del found["no_member_of_ours"]


def check(schemas, name, path):
    schema = json.loads((schemas / f"{name}.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    text = path.read_text(encoding="utf-8")
    documents = [json.loads(part) for part in (text.splitlines() if path.suffix == ".ndjson" else [text])]
    valid = bool(documents)
    if not documents:
        print(f"{name}: {path.name} holds no document")
    for document in documents:
        errors = list(validator.iter_errors(document))
        valid = valid and not errors
        for error in errors[:5]:
            print(f"{name}: {path.name}: {'.'.join(map(str, error.absolute_path))}: {error.message[:300]}")
    if valid:
        for place in sorted({place for document in documents[:3] for place in open_objects(validator, document)}):
            print(f"open {name} {place}")
    return valid


def main(schemas, pairs):
    results = [check(schemas, name, pathlib.Path(path)) for name, _, path in (pair.partition("=") for pair in pairs)]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2:]))
