"""Runs the tests of the Python package.

usage: run_tests.py PROGRAM SOURCE_DIR PACKAGE_DIR [ARGUMENTS of pytest...]; exits with 77 (skipped) without pytest or the
compiled part of the package
"""

import os
import pathlib
import sys

SKIPPED = 77
program, source, package = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
sys.dont_write_bytecode = True
os.environ |= {"STEREOBENCH_PROGRAM": str(program), "STEREOBENCH_SOURCE": str(source), "PYTHONDONTWRITEBYTECODE": "1"}
sys.path.insert(0, str(package))

try:
    import pytest
except ImportError:
    print("pytest is missing: skipped (apt-get install python3-pytest)")
    sys.exit(SKIPPED)
if not list((package / "stereobench").glob("_core*.so")):
    print("the compiled part of the package is not built: skipped (apt-get install pybind11-dev python3-dev)")
    sys.exit(SKIPPED)

sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", str(pathlib.Path(__file__).parent), *sys.argv[4:]]))
