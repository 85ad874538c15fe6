"""Data sets that `stereobench render` wrote, as numpy arrays.

    from stereobench import datasets

    dataset = datasets.open_dataset("out/dataset")
    for frame in dataset:
        print(frame.step, frame.t_s, frame.left.picture.shape, frame.left.depth_m.max())

Files are opened when their values are asked for. `open_dataset` itself reads dataset.json and the manifest alone. PNG files and
calibrations are read by OpenCV (Debian's python3-opencv). docs/guide/python_loaders.md shows everything.
"""

from .calibration import Calibration
from .dataset import Dataset, open_dataset, open_seeds
from .errors import DatasetError
from .frame import Camera, Frame
from .pictures import Visibility

__all__ = ["Calibration", "Camera", "Dataset", "DatasetError", "Frame", "Visibility", "open_dataset", "open_seeds"]
