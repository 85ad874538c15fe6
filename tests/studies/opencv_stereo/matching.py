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
FLAT_LEVELS = 4  # standard deviation within a block


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
    """One row a pixel that has truth: error in px (nan for nothing), disparity, whether occluded, contrast, column."""
    left, right = (cv2.imread(str(folder / camera / name)) for camera in ("image_2", "image_3"))
    truth = read_disparity(folder / "disp_occ_0" / name)
    seen_by_both = np.isfinite(read_disparity(folder / "disp_noc_0" / name))
    there = np.isfinite(truth)
    error = estimate(left, right) - truth
    column = np.broadcast_to(np.arange(truth.shape[1]), truth.shape)
    return np.column_stack([values[there] for values in (error, truth, ~seen_by_both, contrast(left), column)])


def line(title, error, of):
    given = np.isfinite(error)
    bad = [np.mean(~(np.abs(error) <= limit)) for limit in LIMITS_PX]
    bad_given = [np.mean(np.abs(error[given]) > limit) for limit in LIMITS_PX]
    good = error[np.abs(error) <= LIMITS_PX[0]]
    cells = [title, f"{error.size / of:.1%}", f"{given.mean():.1%}"]
    cells += [f"{share:.1%}" for share in bad + bad_given] + [f"{good.mean():+.3f}", f"{good.std():.3f}"]
    return "| " + " | ".join(cells) + " |"


def table(rows):
    error, disparity, occluded, texture, column = rows.T
    both = (occluded == 0) & (column >= DISPARITIES)
    steps = [0, *np.quantile(disparity[both], (0.25, 0.5, 0.75)), np.inf]
    parts = {"all": np.full(error.size, True), "not occluded": occluded == 0,
             f"these, from column {DISPARITIES} on": both}
    for low, high in zip(steps, steps[1:]):
        parts[f"of these, disparity {low:.0f} to {high:.0f} px"] = both & (disparity >= low) & (disparity < high)
    parts[f"of these, contrast below {FLAT_LEVELS} levels"] = both & (texture < FLAT_LEVELS)
    parts[f"of these, contrast from {FLAT_LEVELS} levels on"] = both & (texture >= FLAT_LEVELS)
    print("| pixels | share | given | bad > 1 px | bad > 3 px | > 1 px of given | > 3 px of given | mean of good [px] | "
          "sd of good [px] |")
    print("|---|---|---|---|---|---|---|---|---|")
    for title, part in parts.items():
        print(line(title, error[part], error.size))


def residual_shift(left, right, disparity):
    """How far the right picture is from the left one along the row, after it was shifted by the truth: the sums of
    Lucas and Kanade, gradient times difference and gradient squared."""
    left, right = (cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY).astype(np.float32) for picture in (left, right))
    at = np.arange(left.shape[1]) - disparity
    shifted = np.array([np.interp(np.nan_to_num(x), np.arange(left.shape[1]), row) for x, row in zip(at, right)])
    gradient = (np.gradient(left, axis=1) + np.gradient(shifted, axis=1)) / 2
    inside = cv2.erode(np.isfinite(disparity).astype(np.uint8), np.ones((5, 5))) > 0
    return np.array([(gradient * (left - shifted))[inside].sum(), (gradient**2)[inside].sum()])


def picture_of(folder, name):
    """Left picture and truth above, estimate and error below; the error is white from 3 px on, blue where none is given."""
    left, right = (cv2.imread(str(folder / camera / name)) for camera in ("image_2", "image_3"))
    truth, found = read_disparity(folder / "disp_occ_0" / name), estimate(left, right)

    def coloured(disparity):
        levels = np.nan_to_num(np.clip(disparity * 255 / DISPARITIES, 0, 255)).astype(np.uint8)
        return np.where(np.isfinite(disparity)[..., None], cv2.applyColorMap(levels, cv2.COLORMAP_TURBO), 0)

    error = cv2.cvtColor(np.nan_to_num(np.clip(np.abs(found - truth) * 85, 0, 255)).astype(np.uint8), cv2.COLOR_GRAY2BGR)
    error[~np.isfinite(found)] = (120, 0, 0)
    whole = np.vstack([np.hstack([left, coloured(truth)]), np.hstack([coloured(found), error])]).astype(np.uint8)
    return cv2.resize(whole, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)


def main():
    options = argparse.ArgumentParser(description="OpenCV's semi-global matcher against the truth")
    options.add_argument("folder", type=pathlib.Path, help="a folder in KITTI's stereo layout")
    options.add_argument("--picture", type=pathlib.Path, help="PNG file for the first pair with truth, estimate, error")
    asked = options.parse_args()
    cv2.setNumThreads(1)
    names = sorted(path.name for path in (asked.folder / "image_2").glob("*_10.png"))
    table(np.vstack([examine(asked.folder, name) for name in names]))
    sums = np.zeros(2)
    for name in names:
        pair = (cv2.imread(str(asked.folder / camera / name)) for camera in ("image_2", "image_3"))
        sums += residual_shift(*pair, read_disparity(asked.folder / "disp_noc_0" / name))
    print(f"shift between the pictures that the truth leaves: {sums[0] / sums[1]:+.4f} px")
    if asked.picture:
        cv2.imwrite(str(asked.picture), picture_of(asked.folder, names[0]))


if __name__ == "__main__":
    main()
