"""The worked examples, as a reader runs them."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

import stereobench as sb
from conftest import SOURCE

PACKAGE = pathlib.Path(sb.__file__).parents[1]


def said_by(example):
    done = subprocess.run([sys.executable, f"assets/examples/{example}"], cwd=SOURCE, text=True, capture_output=True,
                          env=os.environ | {"PYTHONPATH": str(PACKAGE)})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_own_detector():
    pytest.importorskip("cv2")
    recall = float(re.search(r"mine: recall (\d\.\d+)", said_by("own_detector.py")).group(1))
    assert 0.3 < recall <= 1


def test_noise_budget():
    """More noise is more error, and the budget is one of the levels but the last."""
    text = said_by("noise_budget.py")
    errors = [float(error) for error in re.findall(r"ATE (\d+\.\d+)", text)]
    assert len(errors) == 5 and errors[0] < errors[2] < errors[4]
    assert re.search(r"a detector may be off by [0-9.]+ px", text)


def test_own_filter():
    """The EKF in Python is as good as ours. Red where its map or its covariance is scored otherwise."""
    rows = {name: float(ate) for name, ate in re.findall(r"^(\w+) +ATE +(\d+\.\d+) mm", said_by("own_filter.py"), re.M)}
    assert rows["mine"] == pytest.approx(rows["ekf"], rel=0.3)
