"""A detector in Python: what it is shown, and what its answers become."""

import concurrent.futures

import numpy as np
import pytest

import stereobench as sb
from conftest import BALL_CIRCLE, SHORT


def without_names(result):
    """A result but for who detected, and what it was made from."""
    return {key: value for key, value in result.items() if key not in ("detector", "made_from")}


def test_a_detector_is_shown_each_frame_in_order(circle):
    steps = []

    def detector(frame):
        assert frame.left.shape == frame.right.shape == (frame.setup["rig"]["height_px"], frame.setup["rig"]["width_px"], 3)
        assert not hasattr(frame, "truth")
        steps.append(frame.step)
        return []

    result = sb.run(circle, detector=detector)
    assert steps == list(range(len(circle.path))) * 2
    assert result["vision"]["recall"] == 0


def test_the_same_answers_score_the_same(circle):
    """In the loop and in `run`, with numbers of numpy. Red where answers go to another frame or lose digits."""
    answers = {}
    drive = sb.Drive(circle, 0)
    filters = [drive.filter(name) for name in circle.filters]
    for frame in drive:
        answers[frame.step] = [
            {"colour": np.int64(ball["colour"]), "left_px": np.array(ball["left_px"]), "right_px": ball["right_px"],
             "centre_sd_px": np.float64(0.05)} for ball in frame.observe()]
        seen = frame.measure(answers[frame.step])
        for one in filters:
            one.step(frame.odometry, seen)
    stepped = drive.score(filters)
    one_seed = sb.Scenario(BALL_CIRCLE, SHORT, seeds=[0], filters="ekf,smoother")
    run = sb.run(one_seed, detector=lambda frame: answers[frame.step])
    assert run["vision"]["recall"] > 0.9
    assert stepped["detector"] == run["detector"] == "callable"
    assert without_names(stepped) == without_names(run)


def test_jobs_change_nothing(circle):
    """Two drives ask at once. Red where an answer goes to the drive that asked last."""
    def detector(frame):
        return [{"colour": 3, "left_px": [500 + float(frame.left.mean()), 380.2], "right_px": [402.9, 380.2],
                 "centre_sd_px": 0.5}]

    assert sb.run(circle, detector=detector, jobs=2).text == sb.run(circle, detector=detector).text


def test_a_frame_can_be_made(circle):
    """As a test of a detector does. Red where rows and columns are swapped, or left and right."""
    frame = sb.Drive(circle).frame(0)
    again = sb.Frame(3, 7, frame.left, frame.right, frame.setup)
    assert (again.step, again.stamp_ns, again.setup) == (3, 7, frame.setup)
    assert np.array_equal(again.left, frame.left) and np.array_equal(again.right, frame.right)
    with pytest.raises(ValueError, match="height x width x 3"):
        sb.Frame(0, 0, frame.left[0], frame.right, {})


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_a_detector_raises_is_raised(circle, jobs):
    """Red where the exception becomes another one on its way through C++, or from the worker."""
    class Mine(Exception):
        pass

    def detector(frame):
        raise Mine("no model")

    with pytest.raises(Mine, match="no model"):
        sb.run(circle, detector=detector, jobs=jobs)


def test_each_thread_has_its_own_detector(circle):
    """Red where drives of one process ask the detector that was given last."""
    def found_by(colour):
        ball = {"colour": colour, "left_px": [511.5, 380.2], "right_px": [402.9, 380.2], "centre_sd_px": 0.5}
        seen = []

        def detector(frame):
            seen.append(frame.step)
            return [ball]

        return sb.run(circle, detector=detector).text, seen

    alone = [found_by(colour) for colour in (3, 4)]
    assert alone[0][0] != alone[1][0]
    with concurrent.futures.ThreadPoolExecutor(2) as threads:
        assert list(threads.map(found_by, (3, 4))) == alone


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("answer, message", [
    ([{"colour": 99, "left_px": [1, 2], "right_px": [0, 2]}], "balls[0].colour: expected"),
    ([{"colour": 1, "left_px": [1, 2]}], "balls[0]"),
    ([{"colours": 1}], "colours"),
    ([7], "balls[0]"),
])
def test_an_answer_that_is_none_is_the_programs_error(circle, answer, message, jobs):
    with pytest.raises(sb.RunCrash) as error:
        sb.run(circle, detector=lambda frame: answer, jobs=jobs)
    assert str(error.value).startswith("detector: frame 0: ") and message in str(error.value)


@pytest.mark.parametrize("answer", [None, 7, [object()]])
def test_an_answer_of_another_type_is_a_type_error(circle, answer):
    with pytest.raises(TypeError):
        sb.Drive(circle).frame(0).measure(answer if answer is not None else 7)


def test_a_detector_is_a_callable(circle):
    with pytest.raises(TypeError, match="detector: expected a callable"):
        sb.run(circle, detector="python3 my_detector.py")


def test_an_oracle_has_no_pictures(field):
    frame = sb.Drive(field).frame(0)
    assert frame.left is None and frame.truth is None
    with pytest.raises(sb.Error, match="frame 0: expected no balls"):
        frame.measure([{"colour": 0, "range_m": 2.0, "bearing_rad": 0.1}])


def test_a_frame_is_measured_once(circle):
    """Red where faults with a memory are drawn twice."""
    drive = sb.Drive(circle)
    drive.frame(1).measure()
    with pytest.raises(sb.Error, match="expected a frame after the last one"):
        drive.frame(0).measure()
