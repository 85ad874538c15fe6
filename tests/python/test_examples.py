"""The worked examples, as a reader runs them, and their pages in the guide."""

import os
import pathlib
import re
import subprocess
import sys

import example_pages
import pytest

import stereobench as sb
from conftest import SOURCE

PAGES = SOURCE / "docs/guide/examples"


@pytest.fixture(scope="module")
def rendered(tmp_path_factory):
    """Folder with the pages as they are made now. Pictures need cv2."""
    pytest.importorskip("cv2")
    out = tmp_path_factory.mktemp("examples")
    done = subprocess.run([sys.executable, example_pages.__file__, SOURCE, out], text=True, capture_output=True,
                          env=os.environ | {"PYTHONPATH": str(pathlib.Path(sb.__file__).parents[1])})
    assert done.returncode == 0, done.stderr
    return out


def fingerprint(folder):
    return [re.search(r"pixels: (.+) -->", page.read_text()).group(1) for page in sorted(folder.glob("*.md"))]


def test_pages_are_what_the_scripts_give(rendered):
    """Texts and pictures, to the byte. Red where a script, or what it prints or draws, changes and its page does not."""
    assert sorted(path.name for path in rendered.iterdir()) == sorted(path.name for path in PAGES.iterdir())
    if fingerprint(rendered) != fingerprint(PAGES):
        pytest.skip("other pixels are rendered here than those of the pages")
    for page in PAGES.iterdir():
        assert page.read_bytes() == (rendered / page.name).read_bytes(), page.name


def test_pages_are_small():
    sizes = [page.stat().st_size for page in PAGES.iterdir()]
    assert max(sizes) < 200_000 and sum(sizes) < 500_000


def test_cells():
    """Red where a comment in a cell of code becomes prose, or a line of prose keeps its sign."""
    script = "# %% [markdown]\n# # Title\n#\n# One.\n\n# %%\nx = 1\n\n# Why.\ny = 2\n\n# %%\nprint(x)\n"
    assert example_pages.cells_of(script) == [(True, "# Title\n\nOne."), (False, "x = 1\n\n# Why.\ny = 2"),
                                              (False, "print(x)")]
    with pytest.raises(ValueError, match="expected a script that begins"):
        example_pages.cells_of("import os\n# %%\n")


def test_own_detector(rendered):
    recall = float(re.search(r"mine: recall (\d\.\d+)", (rendered / "own_detector.md").read_text()).group(1))
    assert 0.3 < recall <= 1


def test_noise_budget(rendered):
    """More noise is more error, and all drives at the budget keep the limit."""
    text = (rendered / "noise_budget.md").read_text()
    rows = [(float(level), int(drives), float(error)) for level, drives, error in re.findall(
        r"centres off by (\d\.\d+) px, drives: +(\d+), ATE up to +(\d+\.\d+) mm", text)]
    budget_px = float(re.search(r"may be up to (\d\.\d+):", text).group(1))
    assert rows[0][2] < 1 < rows[-1][2]
    assert [error_mm <= 5 for level, drives, error_mm in rows if (level, drives) == (budget_px, 22)] == [True]


def test_own_filter(rendered):
    """The EKF in Python is as good as ours. Red where x and y of its landmarks are swapped, or those of its poses."""
    rows = {name: [float(ate), float(landmarks)] for name, ate, landmarks in re.findall(
        r"^(\w+) +ATE +(\d+\.\d+) mm, landmarks +([0-9.]+|nan) mm", (rendered / "own_filter.md").read_text(), re.M)}
    assert rows["mine"] == pytest.approx(rows["ekf"], rel=0.3)
