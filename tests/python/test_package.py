"""The package without its compiled part, and its stubs."""

import ast
import inspect
import os
import pathlib
import subprocess
import sys

import pytest

import stereobench as sb
from conftest import SOURCE
from stereobench import _core

PACKAGE = SOURCE / "harness/python/stereobench"


def python(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": str(PACKAGE.parent)})


def test_the_loaders_need_no_compiled_part():
    done = python("import stereobench; from stereobench import datasets; print(datasets.__name__, len(dir(stereobench)))")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("stereobench.datasets ")


@pytest.mark.parametrize("code", ["import stereobench; stereobench.run", "from stereobench import Scenario"])
def test_what_needs_it_says_so_in_one_line(code):
    """Red where the error is that of the import system, which names a file of ours."""
    last = python(code).stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: stereobench.") and "needs the compiled part" in last


def test_unknown_names_are_attribute_errors():
    assert not hasattr(sb, "no_such_thing")
    assert set(sb.__all__) <= set(dir(sb))
    for name in sb.__all__:
        assert getattr(sb, name) is not None


def stub_members():
    """{class or "": names} that the stub states."""
    members = {"": set()}
    for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body:
        if isinstance(node, ast.ClassDef):
            members[""].add(node.name)
            members[node.name] = {part.name if isinstance(part, ast.FunctionDef) else part.target.id
                                  for part in node.body if isinstance(part, (ast.FunctionDef, ast.AnnAssign))}
        elif isinstance(node, ast.FunctionDef):
            members[""].add(node.name)
    return members


def test_stubs_have_what_there_is():
    """Red where a function is added without its stub."""
    stated = stub_members()
    there = {name for name in vars(_core) if not name.startswith("__")}
    assert there == stated[""]
    for name in there:
        thing = getattr(_core, name)
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            own = {part for part in vars(thing) if not part.startswith("__") or part in ("__init__", "__len__")}
            assert own - {"__init__"} == stated[name] - {"__init__"}, name


def signatures(file):
    """{name: (arguments, arguments by name alone)} of what is public in a file's functions and classes."""
    found = {}
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.FunctionDef) and (node.name == "__init__" or not node.name.startswith("_")):
            found[node.name] = [arg.arg for arg in node.args.args], [arg.arg for arg in node.args.kwonlyargs]
    return found


@pytest.mark.parametrize("name", ["results", "scenarios", "studies", "rendering"])
def test_stubs_have_the_signatures(name):
    """Red where an argument is added, renamed or moved without its stub."""
    assert signatures(PACKAGE / f"{name}.pyi") == signatures(PACKAGE / f"{name}.py")


def test_public_names_have_docstrings():
    for name in sb.__all__:
        if name not in ("MEASUREMENT", "LANDMARK"):
            assert inspect.getdoc(getattr(sb, name)), name
