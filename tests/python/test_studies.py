"""Budgets, attributions and sensitivities: those of the program, also with a detector in Python."""

import filecmp
import json
import os
import subprocess
import sys

import pytest

import stereobench as sb
from conftest import BALL_CIRCLE, OPEN_FIELD, SHORT, set_words

BALL = {"colour": 3, "left_px": [511.5, 380.2], "right_px": [402.9, 380.2], "centre_sd_px": 0.5}
METRIC = "filters.smoother.ate_rms_m"
NOISE = {"detector_noise.centre_sd_px": (0, 2)}
PROGRAM = """import json, sys
answers = json.load(open(sys.argv[1]))
for line in sys.stdin:
    said = json.loads(line)
    if "frame" in said:
        print(json.dumps({"frame": said["frame"], "balls": answers[said["frame"]]}), flush=True)
"""

STUDIES = {
    "budget": (lambda scenario, **more: sb.budget(scenario, {"oracle.range_sd_m": (0, 5.0)}, "filters.ekf.ate_rms_m",
                                                  limit=0.5, share=0.6, tolerance=0.1, **more),
               ["--vary", "oracle.range_sd_m=0..5.0", "--metric", "filters.ekf.ate_rms_m", "--limit", "0.5", "--share",
                "0.6", "--tolerance", "0.1"]),
    "attribute": (sb.attribute, []),
    "sensitivity": (lambda scenario, **more: sb.sensitivity(
        scenario, {"oracle.range_sd_m": (0.05, 0.5, "log")}, "filters.ekf.ate_rms_m", by_stream=True, samples=16, **more),
        ["--vary", "oracle.range_sd_m=0.05..0.5:log", "--metric", "filters.ekf.ate_rms_m", "--by-stream", "--samples", "16"]),
}


def small(more=None, seeds="0..2"):
    """A drive with pictures that takes a moment."""
    return sb.Scenario(BALL_CIRCLE, SHORT | (more or {}), seeds=seeds, filters="smoother")


def budget(scenario, share=0.4, **more):
    return sb.budget(scenario, NOISE, METRIC, limit=0.02, share=share, confidence=0.7, tolerance=0.2, **more)


@pytest.mark.parametrize("command", STUDIES)
def test_files_are_those_of_the_program(program, tmp_path, command):
    """All of them, to the byte. Red where an option gets lost on its way to the command line."""
    call, words = STUDIES[command]
    seeds = "0..5"
    program(command, OPEN_FIELD, "--set", "gates=[]", "--set", "path.step_s=2", "--seeds", seeds, "--filters",
            "ekf", *words, "--out", tmp_path / "there")
    scenario = sb.Scenario(OPEN_FIELD, {"gates": [], "path.step_s": 2}, seeds=seeds, filters="ekf")
    result = call(scenario, out=tmp_path / "here")
    names = sorted(os.listdir(tmp_path / "there"))
    assert sorted(os.listdir(tmp_path / "here")) == names and len(names) == 4
    for name in names:
        assert filecmp.cmp(tmp_path / "here" / name, tmp_path / "there" / name, shallow=False), name
    assert (tmp_path / "here" / next(name for name in names if name.endswith(".json"))).read_text() == result.text


def test_at_least_is_the_other_limit(field):
    """What has to be at least its limit where there is no noise. Red where it is taken for the largest value."""
    answer = sb.budget(field, {"oracle.range_sd_m": (0.0, 5.0)}, "filters.ekf.ate_rms_m", at_least=1e-9, share=0.4,
                       confidence=0.6)
    assert answer["relation"] == ">=" and answer["budgets"][0]["outcome"] == "whole range"


def test_a_detector_in_python_answers_as_a_program_does(tmp_path):
    """Red where a study asks ours, or a frame is told another step."""
    scenario = small(seeds=[0])
    answers = [frame.observe() for frame in sb.Drive(scenario)]
    for step, balls in enumerate(answers):
        for ball in balls:
            ball["left_px"][0] += 0.05 * step
    (tmp_path / "answers.json").write_text(json.dumps(answers))
    (tmp_path / "detector.py").write_text(PROGRAM)
    program = {"detector": f"{sys.executable} {tmp_path}/detector.py {tmp_path}/answers.json"}
    mine = budget(scenario, share=0.2, detector=lambda frame: answers[frame.step])
    assert mine["budgets"] == budget(small(program, seeds=[0]), share=0.2)["budgets"]
    assert mine["budgets"] != budget(scenario, share=0.2)["budgets"]


def test_levels_of_noise_share_what_a_detector_saw():
    """It sees each frame once, for all levels. Red where a level renders for itself."""
    steps = []

    def detector(frame):
        steps.append(frame.step)
        return [BALL]

    scenario = small(seeds="0..2")
    answer = budget(scenario, detector=detector)
    assert len({run["level"] for run in answer["budgets"][0]["runs"]}) > 1
    assert steps == list(range(len(scenario.path))) * 3


@pytest.mark.parametrize("study", [
    lambda scenario, **more: sb.attribute(scenario, **more),
    lambda scenario, **more: sb.sensitivity(scenario, NOISE, METRIC, samples=16, **more),
    lambda scenario, **more: sb.sweep(scenario, {"detector_noise.centre_sd_px": [0, 1]}, **more),
])
def test_studies_ask_a_detector_in_python(study):
    class Enough(Exception):
        pass

    seen = []

    def detector(frame):
        seen.append(frame.left.shape)
        raise Enough

    scenario = small()
    with pytest.raises(Enough):
        study(scenario, detector=detector)
    rig = scenario.to_dict()["rig"]
    assert seen == [(rig["height_px"], rig["width_px"], 3)]


def test_what_another_function_saw_is_not_taken_over(tmp_path):
    """A call that broke off leaves drives in its folder. Red where _folder_for leaves them there for the next function."""
    def breaks(frame):
        if frame.step == 0:
            breaks.drives += 1
        if breaks.drives > 1:
            raise RuntimeError("no more")
        return []

    breaks.drives = 0
    scenario = small(seeds="0..1")
    cell = {"camera.gain": [1]}
    with pytest.raises(RuntimeError, match="no more"):
        sb.sweep(scenario, cell, detector=breaks, out=tmp_path)
    assert (tmp_path / "unfinished.drives").exists()
    result = sb.sweep(scenario, cell, detector=lambda frame: [BALL], out=tmp_path)
    assert result.text == sb.sweep(scenario, cell, detector=lambda frame: [BALL]).text


def test_a_folder_that_another_process_works_in_is_left_alone(tmp_path):
    """Red where its drives are removed."""
    lines = "import fcntl, sys; drives = open(sys.argv[1], 'w'); fcntl.lockf(drives, fcntl.LOCK_EX); print(flush=True); input()"
    drives = tmp_path / "unfinished.drives"
    with subprocess.Popen([sys.executable, "-c", lines, drives], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
        other.stdout.readline()
        with pytest.raises(sb.Error, match="another stereobench is writing"):
            sb.sweep(small(), {"camera.gain": [1]}, detector=lambda frame: [], out=tmp_path)
        assert drives.exists()
        other.communicate(b"\n")


@pytest.mark.parametrize("options, words", [
    ({"share": 3}, ["--share", "3"]),
    ({"metric": "filters.smoother.atee"}, ["--metric", "filters.smoother.atee"]),
    ({"vary": {"camera.gian": (1, 2)}}, ["--vary", "camera.gian=1..2"]),
    ({"vary": {"camera.gain": (1, 1)}}, ["--vary", "camera.gain=1..1"]),
    ({"limit": None}, []),
])
def test_errors_are_the_programs_line(program, options, words):
    """Red where the text is ours, or no limit is taken for one."""
    given = {"vary": NOISE, "metric": METRIC, "limit": 0.02} | options
    rest = {"--vary": "detector_noise.centre_sd_px=0..2", "--metric": METRIC, "--limit": "0.02"}
    rest = [word for pair in rest.items() for word in pair if pair[0] != (words or ["--limit"])[0]]
    told = program("budget", BALL_CIRCLE, *set_words(SHORT), *words, *rest, code=2).stderr
    with pytest.raises(sb.Error) as error:
        sb.budget(sb.Scenario(BALL_CIRCLE, SHORT), given.pop("vary"), given.pop("metric"), **given)
    assert told == f"stereobench: {error.value}\n"


def test_a_bad_answer_is_the_programs_error():
    with pytest.raises(sb.RunCrash, match="^detector: frame 0: .*balls\\[0\\]"):
        budget(small(), detector=lambda frame: [7])
