"""What the tests share: the program, and a short scenario with pictures and one without."""

import os
import pathlib
import subprocess

import pytest

import stereobench as sb

SOURCE = pathlib.Path(os.environ["STEREOBENCH_SOURCE"])
BALL_CIRCLE = SOURCE / "assets/scenarios/ball_circle.yaml"
OPEN_FIELD = SOURCE / "assets/scenarios/open_field.yaml"
SHORT = {"path.laps": 0.1, "gates": []}


def set_words(values):
    """Those of the command line for `values`."""
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


@pytest.fixture
def program():
    def call(*words, code=0):
        done = subprocess.run([os.environ["STEREOBENCH_PROGRAM"], *map(str, words)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return done
    return call


@pytest.fixture
def circle():
    return sb.Scenario(BALL_CIRCLE, SHORT, seeds=[0, 1], filters="ekf,smoother")


@pytest.fixture
def field():
    return sb.Scenario(OPEN_FIELD, {"gates": []}, seeds=[0, 1], filters="ekf")
