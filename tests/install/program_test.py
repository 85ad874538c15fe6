"""The installed program, its assets and pages, and the loaders for Python.

usage: program_test.py BUILD_DIR SOURCE_DIR
"""

import email.utils
import gzip
import os
import pathlib
import re
import shutil
import sys
import unittest

from installed import BUILD, SOURCE, files_below, install, one_below, run, scratch_folder

PYTHON = "lib/python3/dist-packages"


def setUpModule():
    global folder, prefix, python, scratch
    scratch = scratch_folder()
    folder = pathlib.Path(scratch.name)
    prefix = install(folder / "program", "program")
    python = install(folder / "python", "python")


def tearDownModule():
    scratch.cleanup()


def stereobench(*words):
    return run(prefix / "bin/stereobench", *words, cwd=folder)


def commands():
    return [line.split()[0] for line in stereobench("complete", "--", "").splitlines()]


class Program(unittest.TestCase):
    def test_assets_are_those_of_the_checkout(self):
        installed = [file for file in files_below(prefix / "share/stereobench")]
        ours = run("git", "-c", "safe.directory=*", "-C", SOURCE, "ls-files", "assets") if (SOURCE / ".git").exists() else ""
        expected = ours.split() or [str(p.relative_to(SOURCE)) for p in (SOURCE / "assets").rglob("*") if p.is_file()]
        self.assertEqual(installed, sorted(path.removeprefix("assets/") for path in expected if "__pycache__" not in path))
        self.assertTrue(os.access(prefix / "share/stereobench/detectors/colour_blobs.py", os.X_OK))

    def test_every_scenario_is_read_where_it_is_installed(self):
        """Red where meshes are not installed beside the scenarios."""
        scenarios = sorted((prefix / "share/stereobench/scenarios").glob("*.yaml"))
        self.assertGreater(len(scenarios), 3)
        for scenario in scenarios:
            stereobench("run", scenario, "--dry-run")
        stereobench("test", prefix / "share/stereobench/suites/quick.yaml", "--dry-run")

    def test_a_scenario_runs(self):
        text = stereobench("run", prefix / "share/stereobench/scenarios/ball_circle.yaml", "--seeds", "0", "--set",
                           "path.laps=0.02", "--set", "gates=[]", "--filters", "ekf", "--out", "out")
        self.assertIn("recall 1.0000", text)
        self.assertTrue((folder / "out/run.json").is_file())

    def test_nothing_of_other_components(self):
        self.assertEqual(sorted(path.name for path in prefix.iterdir()), ["bin", "share"])
        self.assertEqual(os.listdir(prefix / "bin"), ["stereobench"])
        self.assertEqual(sorted(path.name for path in python.iterdir()), ["lib", "share"])


@unittest.skipUnless(shutil.which("help2man"), "help2man is missing (apt-get install help2man)")
class ManPages(unittest.TestCase):
    def test_a_page_for_each_command(self):
        pages = {path.name.removesuffix(".1.gz") for path in (prefix / "share/man/man1").iterdir()}
        self.assertGreater(len(pages), 20)
        self.assertEqual(pages, {"stereobench"} | {f"stereobench-{command}" for command in commands()})

    def test_pages_have_the_help(self):
        text = gzip.decompress((prefix / "share/man/man1/stereobench-render.1.gz").read_bytes()).decode()
        self.assertIn("stereobench-render \\- write a scenario's stereo pairs with their truth as a folder", text)
        self.assertIn("\\fB\\-\\-truth\\-format\\fR", text)
        date = re.search(r"^ -- [^>]*>  (.*)$", (SOURCE / "packaging/changelog").read_text(), re.M).group(1)
        self.assertIn(f'"{email.utils.parsedate_to_datetime(date):%B %Y}"', text)
        self.assertNotIn(str(folder), text)

    def test_the_same_pages_every_time(self):
        again = install(folder / "again", "program") / "share/man/man1"
        for page in (prefix / "share/man/man1").iterdir():
            self.assertEqual(page.read_bytes(), (again / page.name).read_bytes(), page.name)


class Package(unittest.TestCase):
    def test_python_finds_them(self):
        code = "import stereobench; print(stereobench.__file__)"
        text = run("/usr/bin/python3", "-c", code, env={"PYTHONPATH": str(python / PYTHON), "PYTHONDONTWRITEBYTECODE": "1"})
        self.assertEqual(text.strip(), str(python / PYTHON / "stereobench/__init__.py"))

    def test_every_module_is_there(self):
        ours = [file for file in files_below(SOURCE / "harness/python/stereobench") if "__pycache__" not in file]
        there = files_below(python / PYTHON / "stereobench")
        self.assertEqual([file for file in there if not file.endswith(".so")], ours)
        built = [path.name for path in (BUILD / "python/stereobench").glob("_core*.so")]
        self.assertEqual([file for file in there if file.endswith(".so")], built)


if __name__ == "__main__":
    unittest.main(argv=["program_test.py", "--verbose", *sys.argv[3:]])
