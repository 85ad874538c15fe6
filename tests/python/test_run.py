"""What `run`, `sweep` and the step-by-step loop give, beside the program."""

import numpy as np
import pytest

import stereobench as sb
from conftest import BALL_CIRCLE, OPEN_FIELD, SHORT, set_words


def stepped(scenario, balls_of=lambda frame: None):
    """The loop that a user writes."""
    tally = sb.Tally(scenario)
    for seed in scenario.seeds:
        drive = sb.Drive(scenario, seed)
        filters = [drive.filter(name) for name in scenario.filters]
        for frame in drive:
            seen = frame.measure(balls_of(frame))
            for one in filters:
                one.step(frame.odometry, seen)
        tally.add(drive, filters)
    return tally.result()


def test_run_has_the_bytes_of_the_program(program, circle, tmp_path):
    """Red where an option of Scenario does not reach the experiment."""
    program("run", BALL_CIRCLE, *set_words(SHORT), "--seeds", "0,1", "--filters", "ekf,smoother", "--out", tmp_path)
    assert sb.run(circle).text == (tmp_path / "run.json").read_text()


@pytest.mark.parametrize("name", ["circle", "field"])
def test_the_loop_has_the_bytes_of_run(name, request):
    """Red where the drive's stage gets another seed, the tally keeps no logs to check the noise by, or a filter takes a step
    twice."""
    scenario = request.getfixturevalue(name)
    assert stepped(scenario).text == sb.run(scenario).text


def test_faults_and_lost_frames_are_the_same_in_the_loop():
    """Red where latency, a lost frame or the start's noise is handled otherwise than in `run`."""
    scenario = sb.Scenario(BALL_CIRCLE, SHORT | {
        "shutter.drop_probability": 0.4, "detector_noise.latency_frames": 1, "detector_noise.centre_sd_px": 0.3,
        "start_noise.position_sd_m": 0.1}, seeds=[3], filters="ekf,fastslam2")
    assert stepped(scenario).text == sb.run(scenario).text


def test_jobs_and_open_drives_change_nothing(circle):
    """Red where a worker that is forked beside an open GL context hangs or draws otherwise."""
    before = sb.run(circle, jobs=1).text
    drive = sb.Drive(circle)
    drive.frame(0)
    assert sb.run(circle, jobs=2).text == before


def test_files_are_those_of_the_program(circle, tmp_path):
    sb.run(circle, out=tmp_path / "here")
    assert {"run.json", "steps.csv", "report.html"} <= {path.name for path in (tmp_path / "here").iterdir()}


def test_broken_gates_are_told():
    scenario = sb.Scenario(BALL_CIRCLE, SHORT | {"gates": [{"metric": "vision.recall", "at_most": 0.5}]}, filters="ekf")
    result = sb.run(scenario)
    assert len(result.broken_gates) >= 1 and "vision.recall" in result.broken_gates[0]


def test_sweep_has_the_bytes_of_the_program(program, tmp_path):
    """Red where a cell's values are written otherwise than by --vary."""
    program("sweep", OPEN_FIELD, "--vary", "oracle.range_sd_m=0.1,0.3", "--set", "gates=[]", "--seeds", "0,1", "--filters",
            "ekf", "--paired-to", "0.1", "--out", tmp_path)
    scenario = sb.Scenario(OPEN_FIELD, {"gates": []}, seeds="0,1", filters=["ekf"])
    swept = sb.sweep(scenario, {"oracle.range_sd_m": [0.1, 0.3]}, paired_to=0.1)
    assert swept.text == (tmp_path / "sweep.json").read_text()


def test_a_dict_is_a_scenario(circle):
    """Red where a number becomes text on its way through YAML."""
    again = sb.Scenario(circle.to_dict(), seeds=[0], filters="ekf")
    assert again.to_dict() == circle.to_dict()
    assert np.array_equal(again.path, circle.path)


def test_a_drawn_world_is_that_of_the_drive(circle):
    """Red where to_dict leaves the seed out: balls are moved by up to 3 cm."""
    for seed in (0, 5):
        drawn = circle.to_dict(seed)["world"]["balls"]
        balls = sb.Drive(circle, seed).balls
        assert len(drawn) == len(balls)
        places = np.stack([balls[name] for name in ("x_m", "y_m", "z_m")], axis=1)
        assert np.allclose([ball["at_m"] for ball in drawn], places, atol=1e-9)
