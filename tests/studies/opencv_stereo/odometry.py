"""A simple stereo odometry of OpenCV's parts on a data set in KITTI's odometry layout. It knows nothing of stereobench.

usage: odometry.py KITTI_ODOMETRY [--fast-threshold LEVELS]

ORB keypoints of the left picture are matched to the right one along the row, triangulated, matched to the next left
picture, and give its pose by solvePnPRansac. There is no map, no window and no loop closure: errors add up. Prints
KITTI's errors: over all parts of the drive that have a length, the difference of translation in % of the length, and of
rotation in degrees a metre.
"""

import argparse
import pathlib

import cv2
import numpy as np

FEATURES = 2000
TURN_RAD = 0.002  # a step that turns by more is in a corner
ROW_PX = 2
RATIO = 0.8  # Lowe's test
REPROJECTION_PX = 1.0
FIRST_EVERY = 10  # frames between the starts of parts, as in KITTI's development kit
LENGTHS_M = (5, 10, 20, 40, 80)


def read_projections(folder):
    """P0 and P1: the grey cameras."""
    lines = (folder / "sequences/00/calib.txt").read_text().splitlines()
    numbers = {line.split(":")[0]: np.array(line.split(":")[1].split(), float) for line in lines if ":" in line}
    return numbers["P0"].reshape(3, 4), numbers["P1"].reshape(3, 4)


def read_poses(folder):
    """4 x 4 poses of the left camera in the frame of the first one."""
    rows = np.loadtxt(folder / "poses/00.txt").reshape(-1, 3, 4)
    last = np.broadcast_to([[[0.0, 0, 0, 1]]], (len(rows), 1, 4))
    return np.concatenate([rows, last], axis=1)


def matches(of, to):
    """Pairs of indices that pass Lowe's ratio test."""
    if of is None or to is None:
        return []
    pairs = cv2.BFMatcher(cv2.NORM_HAMMING).knnMatch(of, to, k=2)
    return [(pair[0].queryIdx, pair[0].trainIdx) for pair in pairs
            if len(pair) == 2 and pair[0].distance < RATIO * pair[1].distance]


class Features:
    """Keypoints of a left picture with descriptors, and the points of those that the right picture has too."""

    def __init__(self, orb, left, right, projections):
        points, self.descriptors = orb.detectAndCompute(left, None)
        right_points, right_descriptors = orb.detectAndCompute(right, None)
        self.pixels = np.array([point.pt for point in points]).reshape(-1, 2)
        right_pixels = np.array([point.pt for point in right_points]).reshape(-1, 2)
        pairs = np.array(matches(self.descriptors, right_descriptors), int).reshape(-1, 2)
        shift = self.pixels[pairs[:, 0]] - right_pixels[pairs[:, 1]]
        pairs = pairs[(np.abs(shift[:, 1]) <= ROW_PX) & (shift[:, 0] > 1)]
        self.points = np.full((len(points), 3), np.nan)
        if len(pairs):
            homogeneous = cv2.triangulatePoints(*projections, self.pixels[pairs[:, 0]].T, right_pixels[pairs[:, 1]].T)
            self.points[pairs[:, 0]] = (homogeneous[:3] / homogeneous[3]).T


def motion(before, now, camera):
    """The 4 x 4 transform from the later camera's frame to the earlier one's, and how many points agree with it."""
    pairs = [(i, j) for i, j in matches(before.descriptors, now.descriptors) if np.isfinite(before.points[i, 0])]
    if len(pairs) < 6:
        return None, 0
    first, second = np.array(pairs).T
    points, pixels = before.points[first], now.pixels[second]
    found, turn, shift, inliers = cv2.solvePnPRansac(points, pixels, camera, None, iterationsCount=500, confidence=0.9999,
                                                     reprojectionError=REPROJECTION_PX, flags=cv2.SOLVEPNP_EPNP)
    if not found:
        return None, 0
    inliers = inliers.ravel()
    turn, shift = cv2.solvePnPRefineLM(points[inliers], pixels[inliers], camera, None, turn, shift)
    now_from_before = np.eye(4)
    now_from_before[:3, :3], now_from_before[:3, 3] = cv2.Rodrigues(turn)[0], shift.ravel()
    return np.linalg.inv(now_from_before), len(inliers)


def drive(folder, fast_threshold):
    """Estimated poses, the numbers of inliers, and the steps without an estimate (which repeat the motion before)."""
    projections = read_projections(folder)
    orb = cv2.ORB_create(nfeatures=FEATURES, fastThreshold=fast_threshold)
    poses, inliers, lost, last, before = [np.eye(4)], [], [], np.eye(4), None
    for path in sorted((folder / "sequences/00/image_0").iterdir()):
        left = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
        right = cv2.imread(str(folder / "sequences/00/image_1" / path.name), cv2.IMREAD_GRAYSCALE)
        now = Features(orb, left, right, projections)
        if before is not None:
            step, count = motion(before, now, projections[0][:, :3])
            lost += [len(poses)] if step is None else []
            last = last if step is None else step
            poses.append(poses[-1] @ last)
            inliers.append(count)
        before = now
    return np.array(poses), np.array(inliers), lost


def part_errors(truth, estimate, length_m):
    """KITTI's errors of all parts of one length: % of translation, degrees a metre."""
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1))])
    errors = []
    for first in range(0, len(truth), FIRST_EVERY):
        last = np.searchsorted(along, along[first] + length_m)
        if last == len(truth):
            break
        wanted = np.linalg.inv(truth[first]) @ truth[last]
        found = np.linalg.inv(estimate[first]) @ estimate[last]
        error = np.linalg.inv(found) @ wanted
        turn_rad = np.arccos(np.clip((np.trace(error[:3, :3]) - 1) / 2, -1, 1))
        errors.append((100 * np.linalg.norm(error[:3, 3]) / length_m, np.degrees(turn_rad) / length_m))
    return np.array(errors).reshape(-1, 2)


def print_parts(title, truth, estimate):
    errors = {length: part_errors(truth, estimate, length) for length in LENGTHS_M}
    errors["all"] = np.concatenate(list(errors.values()))
    print(f"| {title}: length [m] | parts | translation [%] | rotation [deg/m] |")
    print("|---|---|---|---|")
    for length, of_length in errors.items():
        if len(of_length):
            print(f"| {length} | {len(of_length)} | {of_length[:, 0].mean():.2f} | {of_length[:, 1].mean():.4f} |")


def steps(poses):
    """The transform from each frame but the first to the one before."""
    return np.linalg.inv(poses[:-1]) @ poses[1:]


def angle_rad(transforms):
    return np.arccos(np.clip((np.trace(transforms[:, :3, :3], axis1=1, axis2=2) - 1) / 2, -1, 1))


def with_true_corners(truth, estimate):
    """The estimate with the true motion of steps in corners: what straight stretches alone add up to."""
    poses, corner = [np.eye(4)], angle_rad(steps(truth)) > TURN_RAD
    for wanted, found, turns in zip(steps(truth), steps(estimate), corner):
        poses.append(poses[-1] @ (wanted if turns else found))
    return np.array(poses)


def print_steps(truth, estimate, inliers):
    """Errors of single steps, straight on and in corners. A bias along the axis would be one of scale."""
    error, corner = np.linalg.inv(steps(truth)) @ steps(estimate), angle_rad(steps(truth)) > TURN_RAD
    print("| steps | number | inliers, median | forward, mean [mm] | shift, rms [mm] | turn, rms [deg] |")
    print("|---|---|---|---|---|---|")
    for title, part in (("straight on", ~corner), ("in corners", corner)):
        shift_mm, off_deg = 1e3 * error[part, :3, 3], np.degrees(angle_rad(error[part]))
        print(f"| {title} | {part.sum()} | {np.median(inliers[part]):.0f} | {shift_mm[:, 2].mean():+.2f} | "
              f"{np.sqrt((shift_mm**2).sum(axis=1).mean()):.1f} | {np.sqrt((off_deg**2).mean()):.3f} |")


def main():
    options = argparse.ArgumentParser(description="stereo odometry of OpenCV's parts")
    options.add_argument("folder", type=pathlib.Path, help="a folder in KITTI's odometry layout")
    options.add_argument("--fast-threshold", type=int, default=20, help="of ORB's corners, in levels (OpenCV's: 20)")
    asked = options.parse_args()
    cv2.setNumThreads(1)
    cv2.setRNGSeed(1)
    truth = read_poses(asked.folder)
    estimate, inliers, lost = drive(asked.folder, asked.fast_threshold)
    print_parts("estimate", truth, estimate)
    print_parts("true corners", truth, with_true_corners(truth, estimate))
    print_steps(truth, estimate, inliers)
    path_m = np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1).sum()
    end_m = np.linalg.norm(estimate[-1, :3, 3] - truth[-1, :3, 3])
    print(f"{len(truth)} frames, {path_m:.1f} m; {end_m:.2f} m off at the end ({end_m / path_m:.2%}); "
          f"{len(lost)} steps without an estimate")


if __name__ == "__main__":
    main()
