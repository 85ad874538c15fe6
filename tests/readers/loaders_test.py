"""The loaders of Python, stereobench.datasets, against the files as OpenCV and numpy read them, and against geometry.

usage: loaders_test.py STEREOBENCH SOURCE_DIR; exits with 77 (skipped) where cv2 or numpy is missing.
Mutations that turn it red, each tried: rows of a PFM from the bottom; x and y of flow exchanged, exact or KITTI's; the
camera's pose inverse; the right camera with the pose of the left one; tables read when the data set is opened; no check
of SHA-256; seeds in the order of their folders' names.
"""

import pathlib
import pickle
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"{error}: skipped (apt-get install python3-opencv)")
    sys.exit(SKIPPED)

try:
    import torch
except ImportError:
    torch = None

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / "harness/python"))
sys.path.insert(0, str(SOURCE / "assets/examples"))
from stereobench import datasets  # noqa: E402

SCENARIO = SOURCE / "assets/scenarios/ball_circle.yaml"
SIDES = ("left", "right")


def render(out, *options):
    subprocess.run([STEREOBENCH, "render", SCENARIO, *options, "--out", out], check=True, stdout=subprocess.DEVNULL)


def setUpModule():
    global folder, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    small = ["--set", "path.laps=0.04", "--set", "world.floor=none"]
    exact = ["--truth", "all", "--set", "rig.width_px=400", "--set", "rig.height_px=300", "--set", "rig.focal_px=350"]
    render(folder / "exact", *small, *exact, "--set", "rig.pitch_down_deg=10", "--set", "camera.noise_sd_levels=2")
    late = ["--set", "shutter.late_probability=0.5", "--set", "shutter.late_s=0.1", "--set", "shutter.drop_probability=0.4",
            "--set", "shutter.right_delay_s=0.05"]
    render(folder / "late", "--set", "path.laps=0.08", *late, "--seed", "1")
    render(folder / "kitti", *small, *exact[2:], "--truth", "disparity,match,flow", "--truth-format", "kitti")
    render(folder / "tiff", *small, *exact, "--set", "rig.pitch_down_deg=10", "--set", "camera.noise_sd_levels=2",
           "--truth-format", "tiff")
    render(folder / "several", "--set", "path.laps=0.02", "--frames", "0", "--seeds", "9..10")


def tearDownModule():
    scratch.cleanup()


def broken(name, content=None):
    """A copy of the data set `exact` in which one file has another content, or is missing."""
    copy = folder / "broken"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(folder / "exact", copy)
    if content is None:
        (copy / name).unlink()
    else:
        (copy / name).write_bytes(content)
    return copy


class Arrays(unittest.TestCase):
    def test_are_what_opencv_reads(self):
        wanted = {"picture": ("", "png", np.uint8), "ids": ("_id", "png", np.uint8), "depth_m": ("_depth", "pfm", np.float32),
                  "range_m": ("_range", "pfm", np.float32), "normals": ("_normal", "pfm", np.float32),
                  "surface_ids": ("_surface", "png", np.uint16), "disparity_px": ("_disparity", "pfm", np.float32),
                  "match_px": ("_match", "pfm", np.float32), "flow_px": ("_flow", "pfm", np.float32),
                  "disparity_mask": ("_disparity_fate", "png", np.uint8), "match_mask": ("_match_fate", "png", np.uint8),
                  "flow_mask": ("_flow_fate", "png", np.uint8)}
        for frame in datasets.open_dataset(folder / "exact")[:2]:
            for side in SIDES:
                for name, (kind, extension, dtype) in wanted.items():
                    with self.subTest(step=frame.step, side=side, name=name):
                        path = folder / f"exact/{side}{kind}/{frame.step:06d}.{extension}"
                        read = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
                        if extension == "pfm" and read.ndim == 3:
                            read = read[..., ::-1]
                        if name in ("match_px", "flow_px"):
                            read = read[..., :2]
                        found = getattr(getattr(frame, side), name)
                        self.assertEqual(found.dtype, dtype)
                        self.assertTrue(np.array_equal(found, read))

    def test_of_pfm_are_maps_of_the_file_that_cannot_be_written(self):
        depth_m = datasets.open_dataset(folder / "exact")[0].left.depth_m
        self.assertIsInstance(depth_m, np.memmap)
        with self.assertRaises(ValueError):
            depth_m[0, 0] = 1

    def test_of_tiff_are_those_of_pfm(self):
        for exact, tiff in zip(datasets.open_dataset(folder / "exact"), datasets.open_dataset(folder / "tiff")):
            for name in ("depth_m", "range_m", "normals", "disparity_px", "match_px", "flow_px"):
                if exact.left.has(name.split("_")[0].removesuffix("s")):
                    self.assertTrue(np.array_equal(getattr(exact.left, name), getattr(tiff.left, name)), name)
        self.assertFalse(list((folder / "tiff").glob("**/*.pfm")))
        with self.assertRaisesRegex(datasets.DatasetError, "expected a TIFF file of floats"):
            (folder / "tiff/left_depth/000000.tiff").write_bytes(b"II*")
            datasets.open_dataset(folder / "tiff")[0].left.depth_m

    def test_of_kitti_are_the_exact_ones_within_half_a_level(self):
        exact, kitti = (datasets.open_dataset(folder / name)[0] for name in ("exact", "kitti"))
        kitti_pitch = kitti.left.disparity_px
        self.assertTrue(np.array_equal(np.isfinite(kitti_pitch), cv2.imread(
            str(folder / "kitti/left_disparity/000000.png"), cv2.IMREAD_UNCHANGED) > 0))
        self.assertEqual(exact.left.flow_px.shape, kitti.left.flow_px.shape)
        depth_m = kitti.left.depth_m
        there = np.isfinite(depth_m) & np.isfinite(kitti_pitch)
        self.assertGreater(there.sum(), 1000)
        self.assertLessEqual(np.abs(kitti_pitch[there] - 350 * 0.12 / depth_m[there]).max(), 1 / 512 + 1e-4)
        match = kitti.left.match_px
        self.assertLessEqual(np.abs(match[there][:, 0] + kitti_pitch[there]).max(), 1 / 512 + 1 / 128 + 1e-4)
        self.assertEqual(np.abs(match[there][:, 1]).max(), 0)
        self.assertTrue((match[~there] == 0).all())


class Geometry(unittest.TestCase):
    def test_rays_of_a_balls_pixels_meet_the_ball(self):
        for name in ("exact", "late"):
            dataset = datasets.open_dataset(folder / name)
            K, pixels = dataset.true_calibration.K, 0
            for camera in (getattr(frame, side) for frame in dataset for side in SIDES):
                camera_from_world, ids = np.linalg.inv(camera.world_from_camera), camera.ids
                for ball in dataset.balls[np.unique(ids[ids > 0]) - 1]:
                    centre = (camera_from_world @ [ball["x_m"], ball["y_m"], ball["z_m"], 1])[:3]
                    v, u = np.nonzero(ids == ball["ball_id"] + 1)
                    rays = np.linalg.solve(K, np.stack([u, v, np.ones_like(u)]))
                    rays /= np.linalg.norm(rays, axis=0)
                    beside_m = np.linalg.norm(np.cross(rays.T, centre), axis=1)
                    self.assertLess(beside_m.max(), ball["radius_m"] * (1 + 1e-4))
                    pixels += len(u)
            self.assertGreater(pixels, 5000)

    def test_disparity_is_focal_length_times_baseline_over_depth(self):
        dataset = datasets.open_dataset(folder / "exact")
        rig = dataset.true_calibration
        self.assertAlmostEqual(rig.P2[0, 3], -rig.K[0, 0] * rig.baseline_m)
        left = dataset[0].left
        there = np.isfinite(left.depth_m)
        self.assertTrue(0 < there.sum() < there.size)
        self.assertTrue(np.allclose(left.disparity_px[there], rig.K[0, 0] * rig.baseline_m / left.depth_m[there], rtol=1e-5))
        self.assertTrue(np.isinf(left.disparity_px[~there]).all())
        self.assertTrue(np.array_equal(there, left.disparity_mask != datasets.Visibility.NOTHING))

    def test_flow_leads_to_the_point_in_the_next_picture(self):
        now, after = datasets.open_dataset(folder / "exact")[:2]
        K = datasets.open_dataset(folder / "exact").true_calibration.K
        for side in SIDES:
            first, second = getattr(now, side), getattr(after, side)
            v, u = np.nonzero(np.isfinite(first.depth_m))
            z = first.depth_m[v, u].astype(float)
            points = np.stack([(u - K[0, 2]) / K[0, 0] * z, (v - K[1, 2]) / K[1, 1] * z, z, np.ones_like(z)])
            points = np.linalg.inv(second.world_from_camera) @ first.world_from_camera @ points
            fixed = points[2] > 0.2
            projected = (K @ points[:3, fixed])[:2] / points[2, fixed]
            wanted = projected.T - np.stack([u, v], axis=1)[fixed]
            self.assertLess(np.abs(first.flow_px[v, u][fixed] - wanted).max(), 0.01)

    def test_seen_balls_are_those_of_the_table(self):
        dataset = datasets.open_dataset(folder / "exact")
        for frame in dataset:
            for side in SIDES:
                camera = getattr(frame, side)
                self.assertEqual({k - 1 for k in np.unique(camera.ids) if k},
                                 set(camera.balls["ball_id"][camera.balls["px_count_visib"] > 0]))
                for ball in camera.balls:
                    self.assertEqual(ball["px_count_visib"], (camera.ids == ball["ball_id"] + 1).sum())
                    made = dataset.balls[ball["ball_id"]]
                    world = camera.world_from_camera @ [*ball["centre_in_camera_m"], 1]
                    self.assertTrue(np.allclose(world[:3], [made["x_m"], made["y_m"], made["z_m"]], atol=1e-9))


class Sequence(unittest.TestCase):
    def test_has_length_indices_and_slices(self):
        dataset = datasets.open_dataset(folder / "late")
        pictures = sorted(int(path.stem) for path in (folder / "late/left").iterdir())
        self.assertNotEqual(pictures, list(range(len(pictures))))  # or this shows nothing
        self.assertEqual([frame.step for frame in dataset], pictures)
        self.assertEqual(len(dataset), len(pictures))
        self.assertEqual([frame.step for frame in dataset[1:]], pictures[1:])
        self.assertEqual(dataset[-1].step, pictures[-1])
        self.assertEqual(dataset.at_step(pictures[-1]).step, pictures[-1])
        with self.assertRaises(IndexError):
            dataset[len(pictures)]
        with self.assertRaisesRegex(datasets.DatasetError, "step 2 has no pictures, expected"):
            dataset.at_step(2)

    def test_tables_are_what_numpy_reads(self):
        dataset = datasets.open_dataset(folder / "late")
        for name in ("frames", "groundtruth", "odometry", "observations", "landmarks", "balls"):
            read = np.genfromtxt(folder / f"late/{name}.csv", delimiter=",", names=True)
            found = getattr(dataset, name)
            self.assertEqual(found.dtype.names, read.dtype.names)
            for column in read.dtype.names:
                self.assertTrue(np.array_equal(found[column], read[column], equal_nan=True), (name, column))
        self.assertTrue(np.isnan(dataset.frames["x_m"][2]))
        last = dataset[-1]
        self.assertEqual(last.t_s, dataset.frames["t_s"][-1])
        self.assertEqual(len(last.observations), (dataset.observations["t_s"] == last.t_s).sum())
        self.assertGreater(len(last.observations), 0)
        surfaces = datasets.open_dataset(folder / "exact").surfaces
        self.assertEqual((surfaces[0]["surface_id"], surfaces[0]["kind"]), (1, "ball"))

    def test_several_seeds_are_a_data_set_each_in_the_order_of_seeds(self):
        found = datasets.open_seeds(folder / "several")
        self.assertEqual([(seed, dataset.folder.name) for seed, dataset in found.items()], [(9, "seed_9"), (10, "seed_10")])
        with self.assertRaisesRegex(datasets.DatasetError, "opened by open_seeds"):
            datasets.open_dataset(folder / "several")
        with self.assertRaisesRegex(datasets.DatasetError, r"no seed_\* in it"):
            datasets.open_seeds(folder / "exact")

    def test_opens_no_file_before_it_is_asked_for(self):
        copy = folder / "bare"
        copy.mkdir()
        for name in ("dataset.json", "manifest-sha256.txt"):
            shutil.copy(folder / "exact" / name, copy)
        dataset = datasets.open_dataset(copy)
        frames = list(dataset)
        self.assertEqual(len(frames), 3)
        self.assertTrue(frames[0].left.has("flow"))
        self.assertFalse(frames[-1].left.has("flow"))
        with self.assertRaisesRegex(datasets.DatasetError, "left/000000.png: missing"):
            frames[0].left.picture
        with self.assertRaisesRegex(datasets.DatasetError, "frames.csv: missing"):
            frames[0].t_s

    def test_can_be_sent_to_another_process(self):
        dataset = datasets.open_dataset(folder / "exact")
        received = pickle.loads(pickle.dumps(dataset))
        self.assertTrue(np.array_equal(received[0].left.picture, dataset[0].left.picture))


class Errors(unittest.TestCase):
    def expect(self, message, value):
        """`value()` raises a DatasetError of one line that has `message`."""
        with self.assertRaises(datasets.DatasetError) as caught:
            value()
        self.assertNotIn("\n", str(caught.exception))
        self.assertRegex(str(caught.exception), message)

    def test_of_folders(self):
        self.expect("dataset.json: missing, expected a finished folder",
                    lambda: datasets.open_dataset(broken("dataset.json")))
        self.expect("dataset.json: .*expected JSON", lambda: datasets.open_dataset(broken("dataset.json", b"{")))
        self.expect("manifest-sha256.txt: missing, expected a finished folder",
                    lambda: datasets.open_dataset(broken("manifest-sha256.txt")))
        self.expect("manifest-sha256.txt:1: expected a SHA-256",
                    lambda: datasets.open_dataset(broken("manifest-sha256.txt", b"abc  left/000000.png\n")))
        self.expect("no key 'frames'", lambda: datasets.open_dataset(broken("dataset.json", b'{"seed": 0}')))
        self.expect("format 'tum', expected 'plain'",
                    lambda: datasets.open_dataset(broken("dataset.json", b'{"format": "tum"}')))

    def test_of_files(self):
        copy = broken("left_depth/000000.pfm", b"Pf\n")
        dataset = datasets.open_dataset(copy)
        self.expect("no header of a PFM", lambda: dataset[0].left.depth_m)
        copy = broken("left_depth/000000.pfm", b"Pf\n2 2\n-1\n" + bytes(12))
        dataset = datasets.open_dataset(copy)
        self.expect("12 bytes of values, expected 16", lambda: dataset[0].left.depth_m)
        dataset = datasets.open_dataset(broken("left/000000.png", b"no picture"))
        self.expect("left/000000.png: OpenCV cannot decode it", lambda: dataset[0].left.picture)
        dataset = datasets.open_dataset(broken("calibration.yaml", b"%YAML:1.0\n---\nK: 3\n"))
        self.expect("calibration.yaml: K, expected a matrix of 3 x 3", lambda: dataset.calibration)
        dataset = datasets.open_dataset(broken("calibration.yaml", b"{{"))
        self.expect("calibration.yaml: ", lambda: dataset.calibration)
        dataset = datasets.open_dataset(broken("landmarks.csv", b"landmark_id,x_m\n"))
        self.expect("landmarks.csv:1: no column y_m", lambda: dataset.landmarks)
        text = b"landmark_id,x_m,y_m,colour_class\n0,1,2,3\n1,east,2,3\n"
        dataset = datasets.open_dataset(broken("landmarks.csv", text))
        self.expect("landmarks.csv:3: x_m is 'east', expected a number", lambda: dataset.landmarks)
        dataset = datasets.open_dataset(broken("landmarks.csv", text.replace(b"0,1,2,3", b"0,1")))
        self.expect("landmarks.csv:2: 2 cells, expected 4", lambda: dataset.landmarks)
        dataset = datasets.open_dataset(broken("left_balls/000000.jsonl", b'{"ball_id": 0}\n'))
        self.expect("000000.jsonl:1: .*expected a ball", lambda: dataset[0].left.balls)

    def test_of_truth_that_was_not_rendered(self):
        self.expect("--truth flow", lambda: datasets.open_dataset(folder / "late")[0].left.flow_px)
        self.expect("000002.pfm: .*last step", lambda: datasets.open_dataset(folder / "exact")[-1].left.flow_px)

    def test_of_a_flipped_bit(self):
        datasets.open_dataset(folder / "exact", check_sha256=True)
        depth = bytearray((folder / "exact/right_depth/000001.pfm").read_bytes())
        depth[1000] ^= 1
        copy = broken("right_depth/000001.pfm", bytes(depth))
        datasets.open_dataset(copy)
        self.expect("right_depth/000001.pfm: SHA-256 [0-9a-f]{64}, expected",
                    lambda: datasets.open_dataset(copy, check_sha256=True))


@unittest.skipIf(torch is None, "no torch (Debian's package python3-torch)")
class Torch(unittest.TestCase):
    def test_example_gives_batches(self):
        from torch_dataset import StereoPairs

        pairs = StereoPairs(folder / "exact")
        batches = list(torch.utils.data.DataLoader(pairs, batch_size=2))
        self.assertEqual([len(batch[0]) for batch in batches], [2, 1])
        left, right, disparity_px, visible = batches[0]
        frame = datasets.open_dataset(folder / "exact")[1]
        for picture, of in ((left, frame.left), (right, frame.right)):
            red = torch.from_numpy(of.picture[..., 2].copy())
            self.assertTrue(torch.equal((picture[1, 0] * 255).round().to(torch.uint8), red))
        self.assertTrue(np.array_equal(disparity_px[1].numpy(), frame.left.disparity_px))
        self.assertTrue(np.array_equal(visible[1].numpy(), frame.left.disparity_mask == 255))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], warnings="ignore")
