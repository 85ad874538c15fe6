"""Filters step by step, and a filter of one's own beside them."""

import numpy as np
import pytest

import stereobench as sb


def driven(scenario, name="ekf", seed=0):
    drive = sb.Drive(scenario, seed)
    one = drive.filter(name)
    for frame in drive:
        one.step(frame.odometry, frame.measure())
    return drive, one


def true_poses(scenario):
    return np.stack([scenario.path[name] for name in ("x_m", "y_m", "heading_rad")], axis=1)


def test_state(field):
    """Red where the columns of a covariance are one, or a landmark's x and y are swapped."""
    drive, one = driven(field)
    assert len(one) == len(drive) and one.pose.shape == (3,) and one.covariance.shape == (3, 3)
    assert np.allclose(one.covariance, one.covariance.T)
    landmarks = one.landmarks
    assert landmarks.dtype == sb.LANDMARK
    balls = drive.balls[landmarks["landmark_id"]]
    errors = np.hypot(landmarks["x_m"] - balls["x_m"], landmarks["y_m"] - balls["y_m"])
    assert np.median(errors) < 1.0
    assert one.counters["rejected_inputs"] == 0


@pytest.mark.parametrize("shift", [(0, 0), (1, 0), (0.3, -0.4)])
def test_estimates_of_ones_own_are_scored(field, shift):
    """A true path that is moved is off by that much. Red where x and y, or two steps, are swapped."""
    drive, one = driven(field)
    poses = true_poses(field) + [*shift, 0]
    mine = sb.estimates("mine", drive, poses, np.tile(np.eye(3), (len(drive), 1, 1)))
    result = drive.score([one, mine])
    assert result["filters"]["mine"]["ate_rms_m"]["mean"] == pytest.approx(np.hypot(*shift), abs=1e-9)
    assert result["filters"]["ekf"] == drive.score([one])["filters"]["ekf"]


def test_a_map_of_ones_own_is_scored(field):
    drive, one = driven(field)
    landmarks = np.zeros(len(drive.balls), sb.LANDMARK)
    for name in ("x_m", "y_m"):
        landmarks[name] = drive.balls[name]
    landmarks["landmark_id"] = drive.balls["ball_id"]
    landmarks["colour_class"] = drive.balls["colour"]
    landmarks["covariance"] = np.eye(2) * 1e-4
    result = drive.score([sb.estimates("mine", drive, true_poses(field), landmarks=landmarks)])
    assert result["filters"]["mine"]["landmark_rms_m"]["mean"] == pytest.approx(0, abs=1e-9)


def test_bounds(field):
    """What knows the whole log is never worse. Red where the two are swapped."""
    drive, _ = driven(field)
    bounds = drive.bounds()
    assert bounds["poses"].shape == bounds["smoothed_poses"].shape == (len(drive), 3, 3)
    variances = [np.trace(bounds[name][:, :2, :2], axis1=1, axis2=2) for name in ("poses", "smoothed_poses")]
    assert np.all(variances[1] <= variances[0] * (1 + 1e-6) + 1e-15)


def test_measurements_of_ones_own(field):
    drive = sb.Drive(field)
    one = drive.filter("ekf")
    frame = drive.frame(0)
    mine = np.zeros(1, sb.MEASUREMENT)
    mine["range_m"], mine["covariance"], mine["sd_scale"] = 3.0, np.eye(2) * 1e-4, 1
    one.step(frame.odometry, mine)
    assert len(one.landmarks) == 1
    assert np.hypot(*(one.landmarks[["x_m", "y_m"]].tolist()[0] - one.pose[:2])) == pytest.approx(3.0)


@pytest.mark.parametrize("measurements", [np.zeros(3), np.zeros((1, 1), sb.MEASUREMENT), [[1.0, 2.0]]])
def test_wrong_arrays_are_refused(field, measurements):
    """Wrong dtype: TypeError; wrong shape: ValueError."""
    drive = sb.Drive(field)
    with pytest.raises((TypeError, ValueError)):
        drive.filter("ekf").step(drive.frame(0).odometry, measurements)


@pytest.mark.parametrize("shape", [(3,), (4, 3), (2, 2)])
def test_wrong_shapes_are_told(field, shape):
    drive = sb.Drive(field)
    with pytest.raises(ValueError, match=f"poses: expected an array of {len(drive)} x 3"):
        sb.estimates("mine", drive, np.zeros(shape))


def test_a_filter_ends_with_its_drive(field):
    drive, one = driven(field)
    with pytest.raises(sb.Error, match="as the drive has"):
        one.step(drive.frame(0).odometry, np.zeros(0, sb.MEASUREMENT))
