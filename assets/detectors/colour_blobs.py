#!/usr/bin/python3
"""A simple detector of coloured balls, to be copied and changed.

    stereobench run assets/scenarios/ball_circle.yaml --detector assets/detectors/colour_blobs.py

Pixels whose colour is nearest to the same palette colour are put together to blobs, an ellipse is fitted to each
blob's border, and ellipses of one colour on one row are a ball.
"""
import json
import sys

import cv2
import numpy as np

SMALLEST_RADIUS_PX = 5.0
CENTRE_SD_PX = 0.04  # of a row or a column: with it, `vision.normalised_error` of run.json is about 1


def light_of(level, setup):
    """Linear light of levels, both from 0 to 1."""
    if setup["encoding"] == "srgb":
        return np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return level ** setup.get("gamma", 1.0)


def colour_table(setup):
    """The palette colour of each level of blue, green and red, in steps of 4; 255 is none.

    Shading scales a colour; what it leaves alone is the share of red and of green.
    """
    light = light_of((np.arange(64) * 4 + 2) / 255.0, setup)
    bgr = np.stack(np.meshgrid(light, light, light, indexing="ij"), axis=-1).reshape(-1, 3)
    palette = np.array(setup["palette_rgb"], float)
    shares = bgr[:, [2, 1]] / bgr.sum(axis=1, keepdims=True)
    wanted = palette[:, :2] / palette.sum(axis=1, keepdims=True)
    gaps = np.linalg.norm(shares[:, None] - wanted[None], axis=2)
    clear = (gaps.min(axis=1) < 0.07) & (bgr.max(axis=1) > 0.15)
    return np.where(clear, gaps.argmin(axis=1), 255).astype(np.uint8)


def ellipses(path, table):
    """[colour, column, row, radius] of each round blob of a picture."""
    picture = cv2.imread(path)
    b, g, r = (channel.astype(np.int32) >> 2 for channel in cv2.split(picture))
    colours = table[(b << 12) | (g << 6) | r]
    found = []
    for colour in np.unique(colours[colours != 255]).tolist():
        mask = (colours == colour).astype(np.uint8)
        borders, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        for border in borders:
            left, top, width, height = cv2.boundingRect(border)
            is_cut = min(left, top) == 0 or left + width == mask.shape[1] or top + height == mask.shape[0]
            if is_cut or len(border) < 2.0 * np.pi * SMALLEST_RADIUS_PX * 0.8:
                continue
            (column, row), axes, _ = cv2.fitEllipse(border)
            is_round = min(axes) > 0.85 * max(axes)
            is_full = cv2.contourArea(border) > 0.9 * np.pi / 4.0 * axes[0] * axes[1]
            if is_round and is_full and min(axes) / 2.0 >= SMALLEST_RADIUS_PX:
                found.append([colour, column, row, float(np.mean(axes)) / 2.0 + 0.5])
    return found


def balls(lefts, rights, setup):
    """Pairs up ellipses whose disparity suits their radius: both are inverse to the depth."""
    radius_per_disparity = setup["ball_radius_m"] / setup["rig"]["baseline_m"]
    for colour, column, row, radius in lefts:
        for other, right_column, right_row, right_radius in rights:
            expected = radius_per_disparity * (column - right_column)
            alike = colour == other and abs(row - right_row) < 1.5
            if alike and max(abs(radius - right_radius), abs(radius - expected)) < 1.0 + 0.1 * radius:
                yield {"colour": colour, "left_px": [column, row], "right_px": [right_column, right_row],
                       "left_radius_px": radius, "right_radius_px": right_radius,
                       "centre_sd_px": CENTRE_SD_PX}


def main():
    setup = json.loads(sys.stdin.readline())
    table = colour_table(setup)
    for line in sys.stdin:
        frame = json.loads(line)
        found = list(balls(ellipses(frame["left"], table), ellipses(frame["right"], table), setup))
        print(json.dumps({"frame": frame["frame"], "balls": found}), flush=True)


if __name__ == "__main__":
    main()
