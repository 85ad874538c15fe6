"""What the tests of this folder share: arguments, a scratch folder, and how things are installed and run.

usage of each test: TEST BUILD_DIR SOURCE_DIR
"""

import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77
BUILD, SOURCE = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
MODULES = ["slam", "vision", "worlds", "renderer", "harness"]
sys.dont_write_bytecode = True


def scratch_folder():
    return tempfile.TemporaryDirectory(prefix="stereobench_install_")


def run(*words, **options):
    """What a command prints. Its standard error is part of it."""
    done = subprocess.run([str(word) for word in words], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        raise AssertionError(f"exit code {done.returncode} of {' '.join(map(str, words))}:\n{done.stdout}")
    return done.stdout


def install(prefix, *components):
    for component in components:
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", component)
    return prefix


def one_below(prefix, pattern):
    """The one path below a folder that fits."""
    found = sorted(prefix.glob(pattern))
    assert len(found) == 1, f"{prefix}: expected one {pattern}, got {found}"
    return found[0]


def files_below(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir())


def module_headers():
    """Those that a module installs: all but the bindings of Python."""
    headers = [path for module in MODULES for path in (SOURCE / module).rglob("*.h")]
    return [path for path in headers if "bindings" not in path.parts]
