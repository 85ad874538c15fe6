"""OpenCV's semi-global matcher on a data set in KITTI's stereo layout. It knows nothing of stereobench.

usage: matching.py KITTI_STEREO [--picture PNG]

Prints the share of bad pixels, as KITTI and Middlebury count them: a pixel with truth is bad where the matcher is off by
more than so many px, or gives nothing. `given` leaves out those where it gives nothing. --picture shows the first pair
with truth, estimate and error.
"""

import argparse
import pathlib

import cv2
import numpy as np

LEVELS_PER_PX = 256
BLOCK_PX = 5
DISPARITIES = 128
LIMITS_PX = (1, 3)
FLAT_LEVELS = 4  # standard deviation within a block: twice the noise of the scenario


def matcher():
    """Settings of OpenCV's own example stereo_match.cpp, with a block of 5 px."""
    channels = 3
    return cv2.StereoSGBM_create(minDisparity=0, numDisparities=DISPARITIES, blockSize=BLOCK_PX,
                                 P1=8 * channels * BLOCK_PX**2, P2=32 * channels * BLOCK_PX**2, disp12MaxDiff=1,
                                 preFilterCap=63, uniquenessRatio=10, speckleWindowSize=100, speckleRange=32,
                                 mode=cv2.STEREO_SGBM_MODE_SGBM)


def read_disparity(path):
    """Disparity in px, nan where there is none."""
    levels = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    return np.where(levels == 0, np.nan, levels / LEVELS_PER_PX)


def estimate(left, right):
    """Disparity in px, nan where the matcher gives none."""
    levels = matcher().compute(left, right)
    return np.where(levels < 0, np.nan, levels / 16)


def contrast(picture):
    """Standard deviation of the grey levels in the block around each pixel."""
    grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY).astype(np.float32)
    mean, square = (cv2.blur(values, (BLOCK_PX, BLOCK_PX)) for values in (grey, grey * grey))
    return np.sqrt(np.maximum(square - mean * mean, 0))


def examine(folder, name):
    """One row a pixel that has truth: error in px (nan for nothing), disparity, whether occluded, contrast."""
    left, right = (cv2.imread(str(folder / camera / name)) for camera in ("image_2", "image_3"))
    truth = read_disparity(folder / "disp_occ_0" / name)
    seen_by_both = np.isfinite(read_disparity(folder / "disp_noc_0" / name))
    there = np.isfinite(truth)
    error = estimate(left, right) - truth
    return np.column_stack([values[there] for values in (error, truth, ~seen_by_both, contrast(left))])


def line(title, error, of):
    given = np.isfinite(error)
    bad = [np.mean(~(np.abs(error) <= limit)) for limit in LIMITS_PX]
    bad_given = [np.mean(np.abs(error[given]) > limit) for limit in LIMITS_PX]
    good = error[np.abs(error) <= LIMITS_PX[0]]
    cells = [title, f"{error.size / of:.1%}", f"{given.mean():.1%}"]
    cells += [f"{share:.1%}" for share in bad + bad_given] + [f"{good.mean():+.3f}", f"{good.std():.3f}"]
    return "| " + " | ".join(cells) + " |"


def table(rows):
    error, disparity, occluded, texture = rows.T
    occluded = occluded > 0
    steps = np.concatenate([[0], np.quantile(disparity[~occluded], (0.25, 0.5, 0.75)), [np.inf]])
    print("| pixels | share | given | bad > 1 px | bad > 3 px | > 1 px of given | > 3 px of given | mean of good [px] | sd of good [px] |")
    print("|---|---|---|---|---|---|---|---|---|")
    print(line("all", error, error.size))
    print(line("not occluded", error[~occluded], error.size))
    for low, high in zip(steps, steps[1:]):
        part = ~occluded & (disparity >= low) & (disparity < high)
        print(line(f"these, disparity {low:.0f} .. {high:.0f} px", error[part], error.size))
    left_border = ~occluded & (texture < FLAT_LEVELS)
    print(line(f"these, contrast below {FLAT_LEVELS} levels", error[left_border], error.size))
    print(line(f"these, contrast above {FLAT_LEVELS} levels", error[~occluded & (texture >= FLAT_LEVELS)], error.size))
