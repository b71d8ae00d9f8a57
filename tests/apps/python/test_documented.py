# SPDX-License-Identifier: MIT
"""Every public name tells what it is, for people and for type checkers."""
import ast
import inspect
import pathlib
import unittest

import faultline
import faultline._faultline
from support import ROOT

PACKAGE = pathlib.Path(faultline.__file__).parent


def public_objects():
    for module in (faultline, faultline.cases, faultline.golden):
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing) or inspect.isfunction(thing):
                yield f"{module.__name__}.{name}", thing


def own_members(thing):
    for name, member in vars(thing).items():
        if name.startswith("_"):
            continue
        function = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
        if inspect.isfunction(function):
            yield name, function


class Documented(unittest.TestCase):
    def test_public_names_have_docstrings_and_types(self):
        checked = 0
        for name, thing in public_objects():
            functions = [(name, thing)] if inspect.isfunction(thing) else list(own_members(thing))
            self.assertTrue(thing.__doc__, name)
            for part, function in functions:
                checked += 1
                self.assertTrue(function.__doc__, f"{name}.{part}")
                signature = inspect.signature(function)
                self.assertIsNot(signature.return_annotation, inspect.Signature.empty, f"{name}.{part}")
                for parameter in signature.parameters.values():
                    if parameter.name != "self":
                        self.assertIsNot(parameter.annotation, inspect.Parameter.empty, f"{name}.{part}")
        self.assertGreater(checked, 40)

    def test_all_names_what_is_there(self):
        for module in (faultline, faultline.cases, faultline.golden):
            self.assertEqual(sorted(module.__all__), list(module.__all__), "in order")
            for name in module.__all__:
                self.assertTrue(hasattr(module, name), name)

    def test_the_stub_of_the_compiled_part_names_all_of_it_and_nothing_else(self):
        tree = ast.parse((PACKAGE / "_faultline.pyi").read_text())
        stub = {}
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                stub[node.name] = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                stub[node.name] = set()
            elif isinstance(node, ast.AnnAssign):
                stub[node.target.id] = set()
        there = {name for name in vars(faultline._faultline) if not name.startswith("_")}
        self.assertEqual(set(stub), there)
        for name in there:
            thing = getattr(faultline._faultline, name)
            if inspect.isclass(thing):
                members = {m for m in vars(thing) if not m.startswith("_") or m == "__init__"}
                self.assertEqual(stub[name] | {"__init__"}, members | {"__init__"}, name)
            self.assertTrue(name == "version" or thing.__doc__, name)

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_the_page_names_every_public_name(self):
        page = (ROOT / "docs/python.md").read_text()
        for name in faultline.__all__:
            if not name.startswith("_"):
                self.assertIn(name, page)
        for module in (faultline.cases, faultline.golden):
            for name, _ in inspect.getmembers(module, inspect.isfunction):
                if name in module.__all__:
                    self.assertIn(f"{module.__name__.partition('.')[2]}.{name}", page)
