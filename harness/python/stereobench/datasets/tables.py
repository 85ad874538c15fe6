"""Tables of a data set as structured arrays: one record a line, one field a column."""

from __future__ import annotations

import csv
import json
import pathlib

import numpy as np

from .errors import DatasetError

_REAL, _INTEGER = np.float64, np.int64


def _columns(kind: type, names: str) -> list[tuple]:
    return [(name, kind) for name in names.split()]


#: The columns of each table. An empty cell of a real column is nan. Units are in the names.
TABLES = {
    "odometry.csv": np.dtype(_columns(_REAL, "t_s v_mps w_radps")),
    "observations.csv": np.dtype([("t_s", _REAL), ("landmark_id", _INTEGER), ("range_m", _REAL),
                                  ("bearing_rad", _REAL), ("colour_class", _INTEGER), ("range_var_m2", _REAL),
                                  ("cov_m_rad", _REAL), ("bearing_var_rad2", _REAL)]),
    "landmarks.csv": np.dtype([("landmark_id", _INTEGER), ("x_m", _REAL), ("y_m", _REAL), ("colour_class", _INTEGER)]),
    "groundtruth.csv": np.dtype(_columns(_REAL, "t_s x_m y_m theta_rad")),
    "frames.csv": np.dtype([("step", _INTEGER), ("t_s", _REAL), ("has_pictures", _INTEGER)] +
                           _columns(_REAL, "late_s x_m y_m theta_rad right_x_m right_y_m right_theta_rad")),
    "balls.csv": np.dtype(_columns(_INTEGER, "ball_id colour") +
                          _columns(_REAL, "red green blue x_m y_m z_m radius_m")),
    "surfaces.csv": np.dtype([("surface_id", _INTEGER), ("kind", "U8"), ("index", _INTEGER)]),
}

#: The balls that one camera sees in one frame. Boxes are left, top, width, height in px, all -1 for no pixel.
SEEN_BALLS = np.dtype([("ball_id", _INTEGER), ("colour", _INTEGER), ("centre_in_camera_m", _REAL, 3),
                       ("centre_px", _REAL, 2), ("outline_centre_px", _REAL, 2), ("outline_semi_axes_px", _REAL, 2),
                       ("outline_angle_rad", _REAL), ("px_count_all", _INTEGER), ("px_count_visib", _INTEGER),
                       ("visib_fract", _REAL), ("bbox_obj", _INTEGER, 4), ("bbox_visib", _INTEGER, 4),
                       ("truncated", np.bool_)])


def read_table(path: pathlib.Path) -> np.ndarray:
    """Reads a CSV file whose name is in TABLES. Raises DatasetError with the line that it cannot read."""
    wanted = TABLES[path.name]
    with open(path, newline="", encoding="utf-8") as file:
        lines = csv.reader(file)
        header = next(lines, [])
        missing = [name for name in wanted.names if name not in header]
        if missing:
            raise DatasetError(f"{path}:1: no column {missing[0]}, expected {','.join(wanted.names)}")
        places = [header.index(name) for name in wanted.names]
        records = [_record(path, lines.line_num, line, len(header), places, wanted) for line in lines]
    return np.array(records, dtype=wanted)


def _record(path: pathlib.Path, number: int, line: list[str], width: int, places: list[int], wanted: np.dtype) -> tuple:
    if len(line) != width:
        raise DatasetError(f"{path}:{number}: {len(line)} cells, expected {width}")
    return tuple(_value(path, number, line[place], name, wanted[name]) for place, name in zip(places, wanted.names))


def _value(path: pathlib.Path, number: int, cell: str, column: str, kind: np.dtype):
    if kind.kind == "U":
        return cell
    if kind.kind == "f" and cell == "":
        return np.nan
    try:
        return int(cell) if kind.kind == "i" else float(cell)
    except ValueError:
        expected = "an integer" if kind.kind == "i" else "a number"
        raise DatasetError(f"{path}:{number}: {column} is {cell!r}, expected {expected}") from None


def read_seen_balls(path: pathlib.Path) -> np.ndarray:
    """Reads a file of left_balls/ or right_balls/ as SEEN_BALLS. Raises DatasetError with the line that it cannot read."""
    lines = path.read_text(encoding="utf-8").splitlines()
    balls = np.empty(len(lines), dtype=SEEN_BALLS)
    for number, line in enumerate(lines, start=1):
        try:
            ball = json.loads(line)
            ball.update({f"outline_{key}": value for key, value in ball["outline"].items()})
            for name in SEEN_BALLS.names:
                balls[number - 1][name] = ball[name]
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise DatasetError(f"{path}:{number}: {error!r}, expected a ball as the guide describes it") from None
    return balls
