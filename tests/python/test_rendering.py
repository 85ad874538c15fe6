"""Data sets that are written and verified: those of the program, and the loaders open them."""

import filecmp
import json
import os
import pathlib

import pytest

import stereobench as sb
from conftest import BALL_CIRCLE, SHORT, SOURCE, set_words
from stereobench import datasets


def assert_same_files(here, there):
    """Two folders, to the byte."""
    names = [sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
             for folder in (pathlib.Path(here), pathlib.Path(there))]
    assert names[0] == names[1] and names[0]
    for name in names[0]:
        assert filecmp.cmp(os.path.join(here, name), os.path.join(there, name), shallow=False), name


def test_render_writes_the_files_of_the_program(program, circle, tmp_path):
    """Red where an option gets lost on its way, or the second seed is not rendered."""
    program("render", BALL_CIRCLE, *set_words(SHORT), "--seeds", "0,1", "--format", "plain,tum", "--truth",
            "disparity,flow", "--truth-format", "kitti", "--frames", "0..4:2", "--every", "2", "--crop", "64,32,512,384",
            "--scale", "1/2", "--out", tmp_path / "there")
    here = sb.render(circle, tmp_path / "here", format=["plain", "tum"], truth=["disparity", "flow"], truth_format="kitti",
                     frames="0..4:2", every=2, crop=(64, 32, 512, 384), scale="1/2")
    assert here == tmp_path / "here"
    assert_same_files(here, tmp_path / "there")


def test_a_folder_has_the_answers_of_one_function(circle, tmp_path):
    """Red where a data set that is there, of another function's answers, is taken for this one's."""
    sb.render(circle, tmp_path / "out", frames="0", detector=lambda frame: [])
    with pytest.raises(sb.Error, match="out: expected an empty folder"):
        sb.render(circle, tmp_path / "out", frames="0", detector=lambda frame: [])


def test_the_loader_opens_what_is_written(circle, tmp_path):
    """The pictures are those of a drive. Red where another frame or seed is written."""
    pytest.importorskip("cv2")
    seeds = datasets.open_seeds(sb.render(circle, tmp_path, frames="1..2", truth="disparity"))
    assert list(seeds) == [0, 1]
    for seed, written in seeds.items():
        assert [frame.step for frame in written] == [1, 2] and written[0].left.has("disparity")
        assert (written[0].left.picture == sb.Drive(circle, seed).frame(1).left).all()


def test_a_scenario_without_seeds_has_its_first(tmp_path):
    pytest.importorskip("cv2")
    scenario = sb.Scenario(BALL_CIRCLE, SHORT)
    assert datasets.open_dataset(sb.render(scenario, tmp_path, frames="0")).seed == scenario.seeds[0]


def test_a_detector_in_python_makes_the_observations(tmp_path):
    pytest.importorskip("cv2")
    ball = {"colour": 3, "left_px": [511.5, 380.2], "right_px": [402.9, 380.2], "centre_sd_px": 0.5}
    scenario = sb.Scenario(BALL_CIRCLE, SHORT, seeds=[0])
    written = datasets.open_dataset(sb.render(scenario, tmp_path, detector=lambda frame: [ball] * (frame.step == 2)))
    assert [len(frame.observations) for frame in written] == [0, 0, 1, *[0] * (len(written) - 3)]


def test_a_collection_is_that_of_the_program(program, tmp_path):
    """Of a file and of a dict. Red where the dict's file is gone before it is read, or the splits get lost."""
    collection = {"dataset": "small", "truth": ["disparity"], "drives": [
        {"name": "circle", "scenario": str(BALL_CIRCLE), "set": ["path.laps=0.02"], "frames": "0..1",
         "seeds": {"train": 3, "test": 4}}]}
    (tmp_path / "small.yaml").write_text(json.dumps(collection))
    program("dataset", tmp_path / "small.yaml", "--out", tmp_path / "there")
    for given, name in ((tmp_path / "small.yaml", "file"), (collection, "dict")):
        assert_same_files(sb.dataset(given, tmp_path / name), tmp_path / "there")
    assert sb.verify(tmp_path / "dict") == []
    pytest.importorskip("cv2")
    assert datasets.open_dataset(tmp_path / "dict/train/circle/seed_3").seed == 3
    with pytest.raises(sb.Error, match="^collection:[0-9]+: .*drivs"):
        sb.dataset({"dataset": "small", "drivs": []}, tmp_path / "bad")


def test_verify_names_what_is_wrong(program, circle, tmp_path):
    """Red where faults are left out, or those of the first file alone are told."""
    folder = sb.render(circle, tmp_path, frames="0..1", scale="1/4") / "seed_0"
    assert sb.verify(folder) == sb.verify(folder, format="plain") == []
    for name in ("left/000000.png", "right_depth/000001.pfm"):
        content = bytearray((folder / name).read_bytes())
        content[len(content) // 2] ^= 255
        (folder / name).write_bytes(content)
    faults = sb.verify(folder)
    assert {fault.split(":")[0] for fault in faults} >= {"left/000000.png", "right_depth/000001.pfm"}
    told = program("verify", folder, code=1).stdout.splitlines()
    assert told[:len(faults)] == faults and f"{len(faults)} faults" in told[len(faults)]


@pytest.mark.parametrize("call, words", [
    (lambda scenario, out: sb.render(scenario, out, format="kity"), ["render", BALL_CIRCLE, "--format", "kity"]),
    (lambda scenario, out: sb.render(scenario, out, frames="7..x"), ["render", BALL_CIRCLE, "--frames", "7..x"]),
    (lambda scenario, out: sb.dataset("nowhere.yaml", out), ["dataset", "nowhere.yaml"]),
    (lambda scenario, out: sb.verify("nowhere"), ["verify", "nowhere"]),
    (lambda scenario, out: sb.verify(SOURCE / "assets", format="x"), ["verify", SOURCE / "assets", "--as", "x"]),
])
def test_errors_are_the_programs_line(program, tmp_path, call, words):
    told = program(*words, code=2).stderr
    with pytest.raises(sb.Error) as error:
        call(sb.Scenario(BALL_CIRCLE), tmp_path)
    assert told == f"stereobench: {error.value}\n"
