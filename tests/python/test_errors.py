"""Errors have the program's text, and the interpreter's lock is free while the program works."""

import sys
import threading
import time

import pytest

import stereobench as sb
from conftest import BALL_CIRCLE, set_words


@pytest.mark.parametrize("values", [{"camera.noise_sd_level": 4}, {"path.laps": -1}, {"rig.baseline_m": "wide"}])
def test_a_bad_value_is_the_programs_line(program, values):
    """Red where the text of an override is quoted otherwise."""
    told = program("run", BALL_CIRCLE, *set_words(values), code=2).stderr
    with pytest.raises(sb.Error) as error:
        sb.Scenario(BALL_CIRCLE, values)
    assert f"stereobench: {error.value}\n" in told.replace("error: ", "") or str(error.value) in told


@pytest.mark.parametrize("options, words", [
    ({"filters": "ekff"}, ["--filters", "ekff"]), ({"seeds": "1..x"}, ["--seeds", "1..x"])])
def test_a_bad_option_is_the_programs_line(program, options, words):
    told = program("run", BALL_CIRCLE, *words, code=2).stderr
    with pytest.raises(sb.Error) as error:
        sb.Scenario(BALL_CIRCLE, **options)
    assert str(error.value) in told


def test_a_bad_dict_names_its_line():
    with pytest.raises(sb.Error, match="scenario:[0-9]+: .*colour_of_sky"):
        sb.Scenario({"name": "x", "colour_of_sky": 1})


def test_a_missing_file():
    with pytest.raises(sb.Error, match="nowhere.yaml"):
        sb.Scenario("nowhere.yaml")


def test_errors_are_runtime_errors():
    assert issubclass(sb.Error, RuntimeError) and issubclass(sb.RunCrash, sb.Error)


def ticks_during(action):
    """How often another thread of Python gets its turn, and how long it waits at most, s."""
    interval = sys.getswitchinterval()
    times, over = [time.monotonic()], threading.Event()

    def count():
        while not over.is_set():
            times.append(time.monotonic())
            time.sleep(0.001)

    sys.setswitchinterval(0.0005)
    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    action()
    ended = time.monotonic()
    over.set()
    thread.join()
    sys.setswitchinterval(interval)
    return [t for t in times if began < t < ended], ended - began


def test_other_threads_go_on_while_frames_are_rendered(circle):
    """Red where frame_of keeps the lock: then there is one tick a frame, between two of them."""
    drive = sb.Drive(circle)
    drive.frame(0)
    ticks, _ = ticks_during(lambda: drive.frame(1))
    assert len(ticks) >= 3


def test_other_threads_go_on_while_a_run_goes_on(circle):
    """Red where _run keeps the lock."""
    ticks, seconds = ticks_during(lambda: sb.run(circle, detector=lambda frame: []))
    assert len(ticks) > 20 * seconds


def test_other_threads_go_on_while_a_data_set_is_verified(circle, tmp_path):
    """Red where _verify keeps the lock."""
    folder = sb.render(circle, tmp_path, frames="0") / "seed_0"
    ticks, seconds = ticks_during(lambda: sb.verify(folder))
    assert len(ticks) > 20 * seconds


def test_a_drive_is_one_threads(circle):
    """Two threads at once are an error or take turns, and never crash."""
    drive = sb.Drive(circle)
    drive.frame(0)
    errors = []

    def look():
        for step in range(1, 4):
            try:
                drive.frame(step)
            except sb.Error as error:
                errors.append(str(error))

    threads = [threading.Thread(target=look) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in error for error in errors)


def test_a_detector_may_use_threads(circle):
    """Red where detector_of calls Python without the lock."""
    seen = []

    def detector(frame):
        thread = threading.Thread(target=lambda: seen.append(int(frame.left.mean())))
        thread.start()
        thread.join()
        return []

    sb.run(circle, detector=detector)
    assert len(seen) == 2 * len(circle.path)
