"""One stereo pair of a data set with its truth.

Nothing is kept: each access to an array reads its file again, so keep the array, not the frame.
"""

from __future__ import annotations

import typing

import numpy as np

from .errors import DatasetError
from .pictures import read_kitti_disparity, read_kitti_shift, read_pfm, read_png, read_tiff
from .tables import read_seen_balls

if typing.TYPE_CHECKING:
    from .dataset import Dataset


class Camera:
    """One camera of a frame. H and W are the picture's height and width in px.

    An array raises DatasetError where the data set does not have its file; `has` tells so beforehand. Arrays of PFM
    files (noted "mapped") are read-only maps of the file, of which only what is looked at is loaded. PNG files are
    compressed and decoded as a whole.
    """

    def __init__(self, dataset: Dataset, step: int, side: str):
        """The camera `side` ("left" or "right") at a step of the drive."""
        self._dataset, self._step, self.side = dataset, step, side

    def has(self, truth: str) -> bool:
        """Whether there is a file of `truth`: id, depth, range, normal, surface, disparity, match, flow or balls."""
        return any(self._name(truth, extension) in self._dataset.files for extension in ("png", "pfm", "tiff", "jsonl"))

    @property
    def picture(self) -> np.ndarray:
        """What the camera stored: uint8, H x W x 3, blue green red as cv2.imread gives it.

        Of a set rendered with --picture grey or bayer-rggb: uint8, H x W; with linear16: uint16, H x W x 3.
        """
        return read_png(self._dataset.files.path(f"{self.side}/{self._step:06d}.png"))

    @property
    def ids(self) -> np.ndarray:
        """The id buffer: uint8, H x W; 0 is no ball, k is the ball with ball_id k - 1."""
        return self._png("id")

    @property
    def depth_m(self) -> np.ndarray:
        """Planar Z in the camera frame: float32, H x W, metres, inf for nothing; mapped."""
        return self._floats("depth")

    @property
    def range_m(self) -> np.ndarray:
        """Distance along the ray from the optical centre: float32, H x W, metres, inf for nothing; mapped."""
        return self._floats("range")

    @property
    def normals(self) -> np.ndarray:
        """Unit normals x, y, z in the camera frame, towards the camera: float32, H x W x 3, 0 for nothing; mapped."""
        return self._floats("normal")

    @property
    def surface_ids(self) -> np.ndarray:
        """The surface that each pixel sees: uint16, H x W, as in Dataset.surfaces; 0 for nothing."""
        return self._png("surface")

    @property
    def disparity_px(self) -> np.ndarray:
        """u in the left picture minus u in the right one: float32, H x W, px, inf for nothing; mapped."""
        if self._dataset.truth_format == "kitti":
            return read_kitti_disparity(self._path("disparity", "png"))
        return self._floats("disparity")

    @property
    def match_px(self) -> np.ndarray:
        """Shift x, y to the other camera's picture: float32, H x W x 2, px, 0 for nothing; mapped."""
        return self._shift("match")

    @property
    def flow_px(self) -> np.ndarray:
        """Shift x, y to the next step's picture: float32, H x W x 2, px, 0 for nothing; mapped. The last has none."""
        return self._shift("flow")

    @property
    def disparity_mask(self) -> np.ndarray:
        """The occlusion mask of disparity_px: uint8, H x W, levels of Visibility."""
        return self._png("disparity_fate")

    @property
    def match_mask(self) -> np.ndarray:
        """The occlusion mask of match_px: uint8, H x W, levels of Visibility."""
        return self._png("match_fate")

    @property
    def flow_mask(self) -> np.ndarray:
        """The occlusion mask of flow_px: uint8, H x W, levels of Visibility."""
        return self._png("flow_fate")

    @property
    def balls(self) -> np.ndarray:
        """The balls whose outlines meet the picture: records of tables.SEEN_BALLS."""
        return read_seen_balls(self._path("balls", "jsonl"))

    @property
    def world_from_camera(self) -> np.ndarray:
        """True pose when the camera looked: float64, 4 x 4, m; from the camera's axes (z forward) to the world's."""
        prefix = "" if self.side == "left" else "right_"
        row = self._dataset.frames[self._step]
        world_from_robot = planar_pose(*(row[prefix + name] for name in ("x_m", "y_m", "theta_rad")))
        return world_from_robot @ getattr(self._dataset.true_calibration, f"robot_from_{self.side}_camera")

    def _name(self, truth: str, extension: str) -> str:
        return f"{self.side}_{truth}/{self._step:06d}.{extension}"

    def _path(self, truth: str, extension: str):
        name = self._name(truth, extension)
        if name not in self._dataset.files:
            kind = truth.removesuffix("_fate")
            why = "none, or none of the last step," if kind == "flow" else "none"
            raise DatasetError(f"{self._dataset.folder / name}: {why} in this data set, expected what `stereobench "
                               f"render --truth {kind}` writes")
        return self._dataset.files.path(name)

    def _png(self, truth: str) -> np.ndarray:
        return read_png(self._path(truth, "png"))

    def _floats(self, truth: str) -> np.ndarray:
        if self._dataset.truth_format == "tiff":
            return read_tiff(self._path(truth, "tiff"))
        return read_pfm(self._path(truth, "pfm"))

    def _shift(self, truth: str) -> np.ndarray:
        if self._dataset.truth_format == "kitti":
            return read_kitti_shift(self._path(truth, "png"))
        return self._floats(truth)[..., :2]


class Frame:
    """A step of the drive that has pictures."""

    def __init__(self, dataset: Dataset, step: int):
        """Step `step` of the drive, counted from 0. Opens no file."""
        self._dataset = dataset
        self.step = step
        self.left = Camera(dataset, step, "left")
        self.right = Camera(dataset, step, "right")

    @property
    def t_s(self) -> float:
        """Time stamp in seconds."""
        return float(self._dataset.frames[self.step]["t_s"])

    @property
    def late_s(self) -> float:
        """How much later than `t_s` the cameras looked, in seconds."""
        return float(self._dataset.frames[self.step]["late_s"])

    @property
    def world_from_robot(self) -> np.ndarray:
        """True pose when the left camera looked: float64, 4 x 4, m; from the robot's axes (x forward) to the world's."""
        row = self._dataset.frames[self.step]
        return planar_pose(row["x_m"], row["y_m"], row["theta_rad"])

    @property
    def observations(self) -> np.ndarray:
        """What the detector measured in this pair: records of Dataset.observations."""
        observations = self._dataset.observations
        return observations[observations["t_s"] == self.t_s]


def planar_pose(x_m: float, y_m: float, theta_rad: float) -> np.ndarray:
    """The 4 x 4 transform of a pose on the floor; theta is counter-clockwise from east."""
    cosine, sine = np.cos(theta_rad), np.sin(theta_rad)
    return np.array([[cosine, -sine, 0, x_m], [sine, cosine, 0, y_m], [0, 0, 1, 0], [0, 0, 0, 1]])
