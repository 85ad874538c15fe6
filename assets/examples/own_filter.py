# %% [markdown]
# # A filter of your own beside ours
#
# An EKF with a map, in Python: it is given the same odometry and the same measurements as ours, and scored with the same
# truth. Run this from the folder that has `assets`, with `stereobench` on Python's path.

# %%
import os

import cv2
import numpy as np

import stereobench as sb

scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", {"path.laps": 0.2, "gates": []}, seeds=[0],
                       filters="ekf,smoother")
noise = scenario.to_dict()["odometry_noise"]


# %%
class Ekf:
    """State: x, y, heading of the robot, then x, y of each landmark, in the world frame."""

    def __init__(self, start):
        self.x = np.array(start, float)
        self.P = np.zeros((3, 3))
        self.place = {}  # of a landmark in the state, by its identity

    def predict(self, control):
        v, w, t = control["v_mps"], control["w_radps"], control["duration_s"]
        heading, turned = self.x[2], self.x[2] + w * t
        if abs(w) > 1e-9:  # an arc; its derivatives by v, w and the heading
            ahead = np.array([np.sin(turned) - np.sin(heading), np.cos(heading) - np.cos(turned)]) / w
            by_w = v * (t * np.array([np.cos(turned), np.sin(turned)]) - ahead) / w
        else:
            ahead = t * np.array([np.cos(heading), np.sin(heading)])
            by_w = 0.5 * v * t * t * np.array([-np.sin(heading), np.cos(heading)])
        F = np.eye(len(self.x))
        F[:2, 2] = v * np.array([-ahead[1], ahead[0]])
        G = np.zeros((len(self.x), 2))
        G[:2, 0], G[:2, 1], G[2, 1] = ahead, by_w, t
        Q = np.diag([(noise["v_per_v"] * v) ** 2, (noise["w_per_w"] * w) ** 2])
        self.x[:2] += v * ahead
        self.x[2] = turned
        self.P = F @ self.P @ F.T + G @ Q @ G.T

    def update(self, seen):
        at = self.place.get(int(seen["landmark_id"]))
        if at is None:
            return self.add(seen)
        R = seen["covariance"] + np.diag([1e-3, 5e-5]) ** 2  # no rig is calibrated better
        dx, dy = self.x[at:at + 2] - self.x[:2]
        r2, r = dx * dx + dy * dy, np.hypot(dx, dy)
        H = np.zeros((2, len(self.x)))
        H[:, :3] = [[-dx / r, -dy / r, 0], [dy / r2, -dx / r2, -1]]
        H[:, at:at + 2] = [[dx / r, dy / r], [-dy / r2, dx / r2]]
        off = np.array([seen["range_m"] - r, seen["bearing_rad"] - np.arctan2(dy, dx) + self.x[2]])
        off[1] = np.remainder(off[1] + np.pi, 2 * np.pi) - np.pi
        K = np.linalg.solve(H @ self.P @ H.T + R, H @ self.P).T
        self.x += K @ off
        IKH = np.eye(len(self.x)) - K @ H
        self.P = IKH @ self.P @ IKH.T + K @ R @ K.T

    def add(self, seen):
        r, a = seen["range_m"], self.x[2] + seen["bearing_rad"]
        c, s, n = np.cos(a), np.sin(a), len(self.x)
        J = np.zeros((2, n))
        J[:, :3] = [[1, 0, -r * s], [0, 1, r * c]]
        L = np.array([[c, -r * s], [s, r * c]])
        grow = np.vstack([np.eye(n), J])
        self.P = grow @ self.P @ grow.T
        self.P[n:, n:] += L @ (seen["covariance"] + np.diag([1e-3, 5e-5]) ** 2) @ L.T
        self.x = np.append(self.x, self.x[:2] + r * np.array([c, s]))
        self.place[int(seen["landmark_id"])] = n


# %% [markdown]
# The drive: each frame is rendered and measured once, for all filters.

# %%
drive = sb.Drive(scenario, seed=0)
mine = Ekf(drive.start)
ours = [drive.filter(name) for name in scenario.filters]
poses, covariances = [], []
for frame in drive:
    seen = frame.measure()
    for control in frame.odometry:
        mine.predict(control)
    for one in seen:
        mine.update(one)
    poses.append(mine.x[:3].copy())
    covariances.append(mine.P[:3, :3].copy())
    for one in ours:
        one.step(frame.odometry, seen)

# %% [markdown]
# The map, and the score. `efficiency` is the error over the Cramer-Rao bound: 1 is the best there is.

# %%
landmarks = np.zeros(len(mine.place), sb.LANDMARK)
for row, (identity, at) in zip(landmarks, mine.place.items()):
    row["landmark_id"], row["colour_class"] = identity, -1
    row["x_m"], row["y_m"] = mine.x[at:at + 2]
    row["covariance"] = mine.P[at:at + 2, at:at + 2]
result = drive.score([*ours, sb.estimates("mine", drive, poses, covariances, landmarks)])
for name, scored in result["filters"].items():
    print(f"{name:14} ATE {1e3 * scored['ate_rms_m']['mean']:8.3f} mm, landmarks "
          f"{1e3 * (scored['landmark_rms_m']['mean'] or np.nan):8.3f} mm, efficiency {scored['efficiency']:.2f}")

# %% [markdown]
# The map from above, north up: the path, where each ball is, and its ellipse of three standard deviations, 150 times as
# large as it is. Balls that were not seen have none.

# %%
PX_PER_M, SIZE, LARGER = 90, 600, 150
middle = np.mean([drive.balls["x_m"], drive.balls["y_m"]], axis=1)


def pixel(x, y):
    return np.int32(np.round(SIZE / 2 + PX_PER_M * ([x, y] - middle) * [1, -1])).tolist()


picture = np.full((SIZE, SIZE, 3), 255, np.uint8)
cv2.polylines(picture, [np.array([pixel(*pose[:2]) for pose in poses])], False, (160, 160, 160), 2, cv2.LINE_AA)
for row in landmarks:
    variances, axes = np.linalg.eigh(row["covariance"])
    half_px = np.round(3 * LARGER * PX_PER_M * np.sqrt(variances)).astype(int)
    angle = -np.degrees(np.arctan2(axes[1, 0], axes[0, 0]))
    cv2.ellipse(picture, pixel(row["x_m"], row["y_m"]), half_px.tolist(), angle, 0, 360, (200, 80, 0), 2, cv2.LINE_AA)
for ball in drive.balls:
    cv2.circle(picture, pixel(ball["x_m"], ball["y_m"]), 3, (0, 0, 200), -1, cv2.LINE_AA)
os.makedirs("out", exist_ok=True)
cv2.imwrite("out/own_filter.png", picture)

# %% [markdown]
# ![The map of the EKF in Python](out/own_filter.png)
