"""Picture files as arrays: PFM mapped from the file, PNG and TIFF decoded by OpenCV."""

from __future__ import annotations

import enum
import pathlib
import re

import numpy as np

from .errors import DatasetError

_HEADER = re.compile(rb"(P[fF])\s(\d+)\s(\d+)\s(-?\d+(?:\.\d+)?)\n")
_MOST_HEADER_BYTES = 64
_KITTI_DISPARITY_LEVELS_PER_PX = 256
_KITTI_FLOW_LEVELS_PER_PX = 64
_KITTI_FLOW_ZERO = 1 << 15


class Visibility(enum.IntEnum):
    """Levels of an occlusion mask: what the other picture shows of the point that a pixel sees."""

    NOTHING = 0
    OUTSIDE = 85
    OCCLUDED = 170
    VISIBLE = 255


def read_pfm(path: pathlib.Path) -> np.ndarray:
    """A PFM file as float32 of height x width, or x 3. It is mapped, read-only, and has its top row first."""
    with open(path, "rb") as file:
        header = _HEADER.match(file.read(_MOST_HEADER_BYTES))
    if header is None:
        raise DatasetError(f"{path}: no header of a PFM file, expected Pf or PF, width, height and scale")
    width, height = int(header[2]), int(header[3])
    shape = (height, width) if header[1] == b"Pf" else (height, width, 3)
    order = "<" if float(header[4]) < 0 else ">"
    found, wanted = path.stat().st_size - header.end(), 4 * int(np.prod(shape))
    if found != wanted:
        raise DatasetError(f"{path}: {found} bytes of values, expected {wanted} for {width} x {height} pixels")
    mapped = np.memmap(path, dtype=order + "f4", mode="r", offset=header.end(), shape=shape)
    return mapped[::-1]  # the rows of a PFM begin at the bottom


def read_png(path: pathlib.Path) -> np.ndarray:
    """A PNG file as OpenCV decodes it: 8 or 16 bits, channels in the order blue, green, red."""
    picture = opencv().imread(str(path), opencv().IMREAD_UNCHANGED)
    if picture is None:
        raise DatasetError(f"{path}: OpenCV cannot decode it, expected a PNG file")
    return picture


def read_tiff(path: pathlib.Path) -> np.ndarray:
    """A TIFF file of floats: float32, height x width, or x 3 with red first."""
    picture = opencv().imread(str(path), opencv().IMREAD_UNCHANGED)
    if picture is None or picture.dtype != np.float32:
        raise DatasetError(f"{path}: OpenCV cannot decode it, expected a TIFF file of floats")
    return picture if picture.ndim == 2 else picture[..., ::-1]


def read_kitti_disparity(path: pathlib.Path) -> np.ndarray:
    """Disparity of a KITTI PNG in px: float32, height x width, inf where the file has none."""
    levels = read_png(path)
    return np.where(levels == 0, np.float32(np.inf), levels.astype(np.float32) / _KITTI_DISPARITY_LEVELS_PER_PX)


def read_kitti_shift(path: pathlib.Path) -> np.ndarray:
    """Flow or match of a KITTI PNG in px: float32, height x width x 2 (x, y), 0 where the file has none."""
    levels = read_png(path)
    shift = (levels[..., :0:-1].astype(np.float32) - _KITTI_FLOW_ZERO) / _KITTI_FLOW_LEVELS_PER_PX
    return np.where(levels[..., :1] == 0, np.float32(0), shift)


def opencv():
    """The module cv2. It is imported when the first file needs it."""
    try:
        import cv2
    except ImportError:
        raise DatasetError("cv2: not installed, expected OpenCV's module (Debian's package python3-opencv)") from None
    return cv2
