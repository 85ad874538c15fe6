# %% [markdown]
# # A detector of your own in ten minutes
#
# stereobench renders a robot's drive and knows where every ball is. Your detector is a Python function: it is given
# both pictures, and says where balls are. Run this from the folder that has `assets`, with `stereobench` on Python's path.

# %%
import os

import cv2
import numpy as np

import stereobench as sb

scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", {"path.laps": 0.1, "gates": []}, seeds=[0],
                       filters="smoother")

# %% [markdown]
# What does a frame look like? `left` and `right` are arrays, `setup` is what a detector may know.

# %%
frame = sb.Drive(scenario).frame(0)
print(frame.left.shape, frame.left.dtype, sorted(frame.setup))

# %% [markdown]
# Balls have clear colours. Shading makes a colour darker, and leaves the shares of red, green and blue alone.


# %%
def blobs(picture, setup):
    """(colour, column, row, radius) of each patch of a palette colour that is large and round."""
    light = picture.astype(np.float32) + 1e-3
    shares = light[..., ::-1] / light.sum(axis=2, keepdims=True)
    palette = np.array(setup["palette_rgb"], np.float32)
    palette /= palette.sum(axis=1, keepdims=True)
    is_bright = cv2.compare(picture.max(axis=2), 40, cv2.CMP_GT)
    for colour, wanted in enumerate(palette.astype(float)):
        near = cv2.inRange(shares, tuple(wanted - 0.06), tuple(wanted + 0.06)) & is_bright
        _, _, stats, centres = cv2.connectedComponentsWithStats(near)
        for part in 1 + np.flatnonzero(stats[1:, cv2.CC_STAT_AREA] > 80):
            left, _, width, height, area = stats[part]
            inside = left > 0 and left + width < picture.shape[1]
            if inside and area > 0.7 * width * height and abs(width - height) < 4:
                yield colour, *centres[part], np.sqrt(area / np.pi)


def detector(frame):
    """Patches of one colour on one row are a ball."""
    rights = list(blobs(frame.right, frame.setup))
    return [{"colour": colour, "left_px": [x, y], "right_px": [right_x, right_y], "centre_sd_px": 0.5}
            for colour, x, y, radius in blobs(frame.left, frame.setup)
            for other, right_x, right_y, right_radius in rights
            if colour == other and abs(y - right_y) < 2 and x > right_x and abs(radius - right_radius) < 2]


# %% [markdown]
# How good is it, and how good is the one that comes with stereobench?

# %%
mine = sb.run(scenario, detector=detector)
ours = sb.run(scenario)
for name, result in (("mine", mine), ("ours", ours)):
    vision = result["vision"]
    print(f"{name}: recall {vision['recall']:.3f}, precision {vision['precision']:.3f}, "
          f"range rms {1e3 * (vision['range_rms_m'] or np.nan):.2f} mm, "
          f"smoother's ATE {1e3 * result['filters']['smoother']['ate_rms_m']['mean']:.2f} mm")

# %% [markdown]
# Where does it fail? The truth of a frame has the identity of each pixel: 0 is no ball, k is ball k - 1.

# %%
for frame in sb.Drive(scenario):
    found = {ball["colour"] for ball in detector(frame)}
    missed = {ball["colour"] for ball in frame.observe()} - found
    if missed:
        print(f"frame {frame.step}: misses the balls of colour {sorted(missed)}")

# %% [markdown]
# To look at it: green rings are what it found, white outlines are the balls that there are.

# %%
frame = sb.Drive(scenario).frame(0)
picture = frame.truth.left.copy()
outlines, _ = cv2.findContours((frame.truth.left_ids > 0).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
cv2.drawContours(picture, outlines, -1, (255, 255, 255), 2)
for ball in detector(frame):
    cv2.circle(picture, np.int32(np.round(ball["left_px"])).tolist(), 30, (0, 255, 0), 3)
os.makedirs("out", exist_ok=True)
cv2.imwrite("out/own_detector.png", cv2.resize(picture, None, fx=0.4, fy=0.4, interpolation=cv2.INTER_AREA))

# %% [markdown]
# ![The first frame, with what the detector found](out/own_detector.png)
