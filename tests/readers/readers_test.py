"""Data sets in other people's layouts, read by programs that nobody here wrote, beside the plain one.

usage: readers_test.py STEREOBENCH SOURCE_DIR [OPENCV_SLAM_KITTI]; exits with 77 (skipped) where no reader is there:
torchvision (Debian's python3-torchvision), OpenCV's module `datasets`, and COLMAP (Debian's colmap). Meant to catch: disparities of the right
camera; KITTI's with 128 levels a pixel; disp_occ_1 left out; masks exchanged; inverse poses; P1 with a positive offset.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import cv2
import numpy as np

try:
    import torchvision
    from torchvision.datasets import CarlaStereo, ETH3DStereo, Kitti2012Stereo, Kitti2015Stereo, SceneFlowStereo
except ImportError:
    torchvision = None

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
KITTI_READER = sys.argv[3] if len(sys.argv) > 3 else None
SKIPPED = 77
COLMAP = shutil.which("colmap")
FORMATS = ["kitti-odometry", "kitti-stereo", "kitti-stereo-2012", "middlebury", "eth3d", "sceneflow", "colmap"]


def setUpModule():
    global folder, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    plain = [STEREOBENCH, "render", SOURCE / "assets/scenarios/ball_circle.yaml", "--set", "path.laps=0.06",
             "--set", "camera.noise_sd_levels=2", "--truth", "disparity,flow", "--out", folder / "plain"]
    subprocess.run(plain, check=True, stdout=subprocess.DEVNULL)
    subprocess.run([STEREOBENCH, "export", folder / "plain", "--as", ",".join(FORMATS), "--out", folder],
                   check=True, stdout=subprocess.DEVNULL)


def tearDownModule():
    scratch.cleanup()


def steps():
    return sorted(path.stem for path in (folder / "plain/left").glob("*.png"))


def plain(kind, step, extension):
    return cv2.imread(str(folder / f"plain/{kind}/{step}{extension}"), cv2.IMREAD_UNCHANGED)


@unittest.skipIf(torchvision is None, "no torchvision")
class Torchvision(unittest.TestCase):
    def compare(self, dataset, exact):
        """Each pair is the plain one; disparities are, or within half a level of KITTI's where there is one."""
        self.assertEqual(len(dataset), len(steps()))
        for i, step in enumerate(steps()):
            left, right, disparity = dataset[i][:3]
            for side, picture in (("left", left), ("right", right)):
                self.assertTrue(np.array_equal(np.asarray(picture)[..., ::-1], plain(side, step, ".png")))
            wanted = plain("left_disparity", step, ".pfm")
            found = np.asarray(disparity)[0]
            if exact:
                self.assertTrue(np.array_equal(np.where(np.isfinite(found), found, 0), np.where(np.isfinite(wanted), wanted, 0)))
            else:
                there = np.isfinite(wanted) & (found > 0)
                self.assertGreater(there.mean(), 0.5)
                self.assertLessEqual(np.abs(found - wanted)[there].max(), 1 / 512 + 1e-6)

    def place(self, name, format):
        place = folder / "torchvision" / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.symlink_to(folder / format)
        return folder / "torchvision"

    def test_kitti_2015(self):
        self.compare(Kitti2015Stereo(self.place("Kitti2015/training", "kitti-stereo")), exact=False)

    def test_kitti_2012(self):
        self.compare(Kitti2012Stereo(self.place("Kitti2012/training", "kitti-stereo-2012")), exact=False)

    def test_scene_flow(self):
        self.compare(SceneFlowStereo(self.place("SceneFlow/Monkaa", "sceneflow"), variant="Monkaa"), exact=True)

    def test_eth3d(self):
        dataset = ETH3DStereo(self.place("ETH3D", "eth3d"))
        self.compare(dataset, exact=True)
        for i, step in enumerate(steps()):
            seen = plain("left_disparity_fate", step, ".png")
            mask = cv2.imread(str(folder / f"eth3d/two_view_training_gt/{step}/mask0nocc.png"), cv2.IMREAD_UNCHANGED)
            self.assertTrue(np.array_equal(mask == 255, seen == 255))
            self.assertTrue(np.array_equal(dataset[i][3], seen > 0))

    def test_middlebury(self):
        """torchvision's own reader takes official names alone; Carla's has the same files by other names."""
        for step in steps():
            place = folder / "torchvision/carla-highres/trainingF" / step
            place.mkdir(parents=True)
            for ours, theirs in (("im0.png", "im0.png"), ("im1.png", "im1.png"), ("disp0.pfm", "disp0GT.pfm"),
                                 ("disp1.pfm", "disp1GT.pfm")):
                (place / theirs).symlink_to(folder / "middlebury" / step / ours)
        self.compare(CarlaStereo(folder / "torchvision"), exact=True)


@unittest.skipIf(KITTI_READER is None, "no OpenCV datasets")
class OpencvSlamKitti(unittest.TestCase):
    def test_sequence(self):
        text = subprocess.run([KITTI_READER, str(folder / "kitti-odometry") + "/"], check=True, capture_output=True).stdout
        found = json.loads(text)
        self.assertEqual([found[f"images_{camera}"] for camera in range(4)], [len(steps())] * 4)
        rig = cv2.FileStorage(str(folder / "plain/true_calibration.yaml"), cv2.FILE_STORAGE_READ)
        for camera in range(4):
            projection = rig.getNode("P1" if camera % 2 == 0 else "P2").mat()
            self.assertTrue(np.allclose(np.reshape(found[f"p{camera}"], (3, 4)), projection, rtol=1e-12))
        frames = np.genfromtxt(folder / "plain/frames.csv", delimiter=",", names=True)
        self.assertTrue(np.allclose(found["times"], frames["t_s"] - frames["t_s"][0], atol=1e-6))
        robot_from_camera = rig.getNode("robot_from_left_camera").mat()
        first = None
        for frame, pose in zip(frames, found["poses"]):
            c, s = np.cos(frame["theta_rad"]), np.sin(frame["theta_rad"])
            camera = np.array([[c, -s, 0, frame["x_m"]], [s, c, 0, frame["y_m"]], [0, 0, 1, 0], [0, 0, 0, 1]])
            camera = camera @ robot_from_camera
            first = camera if first is None else first
            self.assertTrue(np.allclose(np.reshape(pose, (3, 4)), (np.linalg.inv(first) @ camera)[:3], atol=1e-9))


@unittest.skipIf(COLMAP is None, "no colmap")
class Colmap(unittest.TestCase):
    """Bundle adjustment of the truth, with intrinsics held, begins at 1e-13 px (COLMAP 3.8); 1e-4 is allowed. Meant to
    catch: poses from the camera to the world; places half a pixel off in one file alone; the centres of outlines."""

    def adjust(self, name, *options):
        out = folder / name
        out.mkdir()
        text = subprocess.run(
            [COLMAP, "bundle_adjuster", "--input_path", folder / "colmap/sparse/0", "--output_path", out,
             "--BundleAdjustment.refine_focal_length", "0", "--BundleAdjustment.refine_principal_point", "0",
             "--BundleAdjustment.refine_extra_params", "0", *options],
            check=True, capture_output=True, text=True, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        return text.stdout + text.stderr

    def test_starts_at_the_truth(self):
        report = self.adjust("adjusted")
        residuals = int(re.search(r"Residuals : (\d+)", report).group(1))
        self.assertGreaterEqual(residuals, 2 * 2 * len(steps()))  # two numbers of a ball in each picture
        self.assertLessEqual(float(re.search(r"Initial cost : (\S+)", report).group(1)), 1e-4)


if __name__ == "__main__":
    if torchvision is None and KITTI_READER is None and COLMAP is None:
        print("no reader is installed: skipped")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], warnings="ignore")
