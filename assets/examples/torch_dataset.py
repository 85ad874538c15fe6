"""A PyTorch Dataset of stereo pairs with disparity, built on stereobench.datasets. Copy it and make it yours.

Needs torch and a data set of `stereobench render --truth disparity`.
"""

import numpy as np
import torch

from stereobench import datasets


class StereoPairs(torch.utils.data.Dataset):
    """Items are left and right (float32, 3 x H x W, red green blue, 0 to 1), disparity (float32, H x W, px; inf for
    nothing), and whether the right camera sees the point (bool, H x W)."""

    def __init__(self, folder):
        self.frames = datasets.open_dataset(folder)

    def __len__(self):
        return len(self.frames)

    def __getitem__(self, index):
        left = self.frames[index].left
        pictures = (left.picture, self.frames[index].right.picture)
        # Copies: torch takes no array that runs backwards, as the rows of a PFM and BGR turned to RGB do.
        left_rgb, right_rgb = (torch.from_numpy(picture[..., ::-1].transpose(2, 0, 1).copy()) / 255 for picture in pictures)
        disparity_px = torch.from_numpy(np.array(left.disparity_px, dtype=np.float32, order="C"))
        visible = torch.from_numpy(left.disparity_mask == datasets.Visibility.VISIBLE)
        return left_rgb, right_rgb, disparity_px, visible
