"""Pictures and tables as numpy arrays."""

import numpy as np
import pytest

import stereobench as sb


def test_pictures_are_views(circle):
    """Red where view_of copies, or an array is writable."""
    frame = sb.Drive(circle).frame(0)
    for array in (frame.left, frame.right, frame.truth.left_ids, frame.truth.left_depth_m):
        assert not array.flags.owndata and not array.flags.writeable
    address = frame.left.__array_interface__["data"][0]
    assert frame.left.__array_interface__["data"][0] == address
    with pytest.raises(ValueError):
        frame.left[0, 0] = 1


def test_a_picture_outlives_frame_and_drive(circle):
    """Red where a view's memory goes back to the renderer while the array lives."""
    drive = sb.Drive(circle)
    frame = drive.frame(0)
    left, ids = frame.left, frame.truth.left_ids
    copies = left.copy(), ids.copy()
    del frame
    for step in range(1, 4):
        drive.frame(step)
    del drive
    sb.Drive(circle, 1).frame(2)
    assert np.array_equal(left, copies[0]) and np.array_equal(ids, copies[1])


def test_truth_agrees_with_itself(circle):
    """Balls lie where ids and depth say, for any seed and frame. Red where left and right, or rows and columns, are
    taken for one another."""
    for seed in range(3):
        drive = sb.Drive(circle, seed)
        rig = drive.setup["rig"]
        for frame in drive:
            truth = frame.truth
            assert truth.left_ids.dtype == np.uint8 and truth.left_depth_m.dtype == np.float32
            for ball in drive.balls:
                rows, columns = np.nonzero(truth.left_ids == ball["ball_id"] + 1)
                right_rows, right_columns = np.nonzero(truth.right_ids == ball["ball_id"] + 1)
                if len(rows) < 200 or columns.min() == 0 or right_columns.min() == 0:
                    continue
                if columns.max() == rig["width_px"] - 1 or right_columns.max() == rig["width_px"] - 1:
                    continue
                depth = truth.left_depth_m[rows, columns].min() + ball["radius_m"]
                expected = rig["focal_px"] * rig["baseline_m"] / depth
                if abs(len(rows) - len(right_rows)) < 0.03 * len(rows):  # not hidden in one of them
                    assert abs(columns.mean() - right_columns.mean() - expected) < 1.0 + 0.05 * expected


def test_rendering_from_a_pose_is_the_frame_without_noise(circle):
    drive = sb.Drive(circle)
    frame = drive.frame(3)
    again = drive.render(*frame.truth.pose)
    assert np.array_equal(again.left, frame.truth.left) and np.array_equal(again.right_depth_m, frame.truth.right_depth_m)
    assert not np.array_equal(drive.render(0.0, 0.0, 1.0).left, again.left)


def test_two_drives_take_turns(circle):
    """Red where a renderer draws into the context of another."""
    alone = [frame.left.copy() for frame in sb.Drive(circle, 0)]
    one, other = sb.Drive(circle, 0), sb.Drive(circle, 1)
    for step in range(3):
        assert np.array_equal(one.frame(step).left, alone[step])
        assert not np.array_equal(other.frame(step).left, alone[step])


def test_tables(circle):
    drive = sb.Drive(circle)
    frame = drive.frame(1)
    assert frame.odometry.dtype.names == ("v_mps", "w_radps", "duration_s", "lateral_mps")
    assert frame.measure().dtype == sb.MEASUREMENT
    assert np.allclose(frame.truth.pose, [circle.path[name][1] for name in ("x_m", "y_m", "heading_rad")])
    with pytest.raises(IndexError, match="expected a step below"):
        drive.frame(len(drive))
