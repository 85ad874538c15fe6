"""The rig of a data set: intrinsics, lens, projections and the places of the cameras."""

from __future__ import annotations

import dataclasses
import pathlib

import numpy as np

from .errors import DatasetError
from .pictures import opencv

_SHAPES = {"K": (3, 3), "D": (1, 5), "P1": (3, 4), "P2": (3, 4), "robot_from_left_camera": (4, 4),
           "robot_from_right_camera": (4, 4)}


@dataclasses.dataclass(frozen=True)
class Calibration:
    """A rig. Arrays are float64. Camera axes are OpenCV's: x right, y down, z forward; the robot's x forward, z up."""

    image_width: int  #: px
    image_height: int  #: px
    K: np.ndarray  #: 3 x 3 camera matrix of both cameras, px; pixel (0, 0) is the centre of the top-left pixel
    D: np.ndarray  #: 5 coefficients of the lens: k1, k2, p1, p2, k3
    P1: np.ndarray  #: 3 x 4, from the left camera's frame (m) to pixels of the left picture, without the lens
    P2: np.ndarray  #: the same to pixels of the right picture
    baseline_m: float  #: distance between the optical centres
    robot_from_left_camera: np.ndarray  #: 4 x 4 transform, m
    robot_from_right_camera: np.ndarray  #: the same of the right camera


def read_calibration(path: pathlib.Path) -> Calibration:
    """Reads calibration.yaml or true_calibration.yaml, a file of OpenCV's FileStorage. Raises DatasetError."""
    cv2 = opencv()
    try:
        storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    except (cv2.error, SystemError):
        raise DatasetError(f"{path}: OpenCV cannot parse it, expected YAML of cv2.FileStorage") from None
    matrices = {key: _matrix(storage, path, key, shape) for key, shape in _SHAPES.items()}
    matrices["D"] = matrices["D"].ravel()
    return Calibration(image_width=int(_number(storage, path, "image_width")),
                       image_height=int(_number(storage, path, "image_height")),
                       baseline_m=_number(storage, path, "baseline_m"), **matrices)


def _matrix(storage, path: pathlib.Path, key: str, shape: tuple[int, int]) -> np.ndarray:
    node = storage.getNode(key)
    matrix = node.mat() if node.isMap() else None
    if matrix is None or matrix.shape != shape:
        raise DatasetError(f"{path}: {key}, expected a matrix of {shape[0]} x {shape[1]}")
    return matrix


def _number(storage, path: pathlib.Path, key: str) -> float:
    node = storage.getNode(key)
    if not (node.isInt() or node.isReal()):
        raise DatasetError(f"{path}: {key}, expected a number")
    return node.real()
