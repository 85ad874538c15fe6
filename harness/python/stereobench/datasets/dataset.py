"""A data set: the frames of one drive, its tables and its rig."""

from __future__ import annotations

import collections.abc
import functools
import os
import pathlib
import typing

import numpy as np

from .calibration import Calibration, read_calibration
from .errors import DatasetError
from .files import ABOUT, Files
from .frame import Frame
from .tables import read_table

_SEED_FOLDER = "seed_"


class Dataset(collections.abc.Sequence):
    """One drive. As a sequence it has the frames with pictures, in the order of their steps.

    Tables and calibrations are read when they are first asked for, and kept. `tables.TABLES` has the tables' columns;
    units are in the names. Frames keep nothing.
    """

    def __init__(self, folder: str | os.PathLike):
        """Opens a finished folder: reads dataset.json and the manifest, no other file. Raises DatasetError."""
        self.folder = pathlib.Path(folder)
        self.files = Files(self.folder)
        self.steps: tuple[int, ...] = tuple(self.files.about["frames"])  #: the steps that have pictures

    def __len__(self) -> int:
        return len(self.steps)

    @typing.overload
    def __getitem__(self, index: int) -> Frame: ...

    @typing.overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index):
        """The index-th frame with pictures, from the end if negative, or a list of frames for a slice."""
        if isinstance(index, slice):
            return [Frame(self, step) for step in self.steps[index]]
        try:
            return Frame(self, self.steps[index])
        except IndexError:
            raise IndexError(f"{self.folder}: frame {index}, expected one of {len(self)}") from None

    def at_step(self, step: int) -> Frame:
        """The frame of a step of the drive, counted from 0. Raises DatasetError where the step has no pictures."""
        if step not in self.steps:
            raise DatasetError(f"{self.folder}: step {step} has no pictures, expected a step that {ABOUT} lists in frames")
        return Frame(self, step)

    @property
    def seed(self) -> int:
        """The seed of the drive."""
        return self.files.about["seed"]

    @property
    def about(self) -> dict[str, typing.Any]:
        """The content of dataset.json: the scenario, the shutter, the asked truth and so on."""
        return self.files.about

    @property
    def truth_format(self) -> str:
        """What `--truth-format` asked for: exact (PFM), kitti (16-bit PNG of disparity, match and flow) or tiff."""
        return self.files.about.get("truth_format", "exact")

    def check_sha256(self) -> None:
        """Reads every file of the data set. Raises DatasetError for the first that is not as it was written."""
        self.files.check_sha256()

    @functools.cached_property
    def calibration(self) -> Calibration:
        """The rig as vision is told it."""
        return read_calibration(self.files.path("calibration.yaml"))

    @functools.cached_property
    def true_calibration(self) -> Calibration:
        """The rig as it is."""
        return read_calibration(self.files.path("true_calibration.yaml"))

    @functools.cached_property
    def frames(self) -> np.ndarray:
        """One record a step, also for steps without pictures: stamps, lateness and true poses of both cameras."""
        return self._table("frames.csv")

    @functools.cached_property
    def groundtruth(self) -> np.ndarray:
        """The true pose of the robot at the stamp of each step."""
        return self._table("groundtruth.csv")

    @functools.cached_property
    def odometry(self) -> np.ndarray:
        """Measured speed and turn rate, each from its `t_s` on."""
        return self._table("odometry.csv")

    @functools.cached_property
    def observations(self) -> np.ndarray:
        """Range and bearing of the balls that the detector found, with their covariance."""
        return self._table("observations.csv")

    @functools.cached_property
    def landmarks(self) -> np.ndarray:
        """True places of the landmarks in the world."""
        return self._table("landmarks.csv")

    @functools.cached_property
    def balls(self) -> np.ndarray:
        """True centres, radii and paint of the balls, in the order of `ball_id`."""
        return self._table("balls.csv")

    @functools.cached_property
    def surfaces(self) -> np.ndarray:
        """What the values of Camera.surface_ids are; with `--truth surface` alone."""
        return self._table("surfaces.csv")

    def _table(self, name: str) -> np.ndarray:
        return read_table(self.files.path(name))


def open_dataset(folder: str | os.PathLike, check_sha256: bool = False) -> Dataset:
    """Opens the data set of one drive. `check_sha256` reads all of its files first. Raises DatasetError."""
    dataset = Dataset(folder)
    if check_sha256:
        dataset.check_sha256()
    return dataset


def open_seeds(folder: str | os.PathLike, check_sha256: bool = False) -> dict[int, Dataset]:
    """Opens a folder of several seeds (seed_0, seed_1, ...) as one data set for each seed, in the order of seeds."""
    folders = [path for path in pathlib.Path(folder).glob(f"{_SEED_FOLDER}*") if path.is_dir()]
    if not folders:
        raise DatasetError(f"{folder}: no {_SEED_FOLDER}* in it, expected a folder of several seeds")
    found = [open_dataset(path, check_sha256) for path in folders]
    return {dataset.seed: dataset for dataset in sorted(found, key=lambda dataset: dataset.seed)}
