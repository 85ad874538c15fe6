"""Shards of WebDataset through Python's tarfile, beside the plain data set.

usage: webdataset_test.py STEREOBENCH SOURCE_DIR; exits with 77 (skipped) without OpenCV. Meant to catch: files of a
sample that are not adjacent; dots in a key; owners and times of the machine; the right camera's pose for the left
one's; its inverse; boxes of the other picture; hidden balls.
"""

import itertools
import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(77)

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
PAIRS_OF_SHARD = 200


def render(scenario, folder, *options):
    subprocess.run([STEREOBENCH, "render", scenario, "--format", "plain,webdataset", "--out", folder, *options],
                   check=True, stdout=subprocess.DEVNULL)


def files_of(shard):
    """Name and bytes of each file, as a stream is read: from the first to the last one."""
    with tarfile.open(shard, "r|") as tar:
        return [(member, tar.extractfile(member).read()) for member in tar]


def setUpModule():
    global folder, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    render(SOURCE / "assets/scenarios/ball_circle.yaml", folder / "set", "--set", "path.laps=0.08", "--seeds", "3",
           "--set", "rig.pitch_down_deg=4", "--set", "rig.right_turn_deg=[0.2, -0.3, 0.1]")


def tearDownModule():
    scratch.cleanup()


def matrix(rig, name):
    return rig.getNode(name).mat()


class Webdataset(unittest.TestCase):
    def setUp(self):
        self.plain = folder / "set/plain"
        self.shard = folder / "set/webdataset/ball_circle_3-000000.tar"
        self.files = files_of(self.shard)
        self.samples = [(key, {member.name.split(".", 1)[1]: content for member, content in members}) for key, members in
                        itertools.groupby(self.files, lambda file: file[0].name.split(".", 1)[0])]

    def steps(self):
        return sorted(path.stem for path in (self.plain / "left").glob("*.png"))

    def test_archive(self):
        names = [member.name for member, _ in self.files]
        self.assertEqual(names, sorted(set(names)))
        for member, content in self.files:
            self.assertEqual((member.mtime, member.uid, member.gid, member.uname, member.gname, member.mode, member.type),
                             (0, 0, 0, "", "", 0o644, tarfile.REGTYPE))
            self.assertEqual(member.size, len(content))
        self.assertEqual(self.shard.read_bytes()[-1024:], bytes(1024))
        listed = subprocess.run(["tar", "-tf", self.shard], check=True, capture_output=True, text=True)
        self.assertEqual((listed.stdout.split(), listed.stderr), (names, ""))

    def test_keys(self):
        """Each sample once, with its three files together."""
        keys = [key for key, _ in self.samples]
        self.assertEqual(keys, [f"ball_circle_3_{step}" for step in self.steps()])
        for _, sample in self.samples:
            self.assertEqual(list(sample), ["json", "left.png", "right.png"])

    def test_pictures(self):
        for step, (_, sample) in zip(self.steps(), self.samples):
            for side in ("left", "right"):
                self.assertEqual(sample[f"{side}.png"], (self.plain / side / f"{step}.png").read_bytes())

    def test_rig_and_poses(self):
        rig = cv2.FileStorage(str(self.plain / "true_calibration.yaml"), cv2.FILE_STORAGE_READ)
        told = json.loads((self.plain / "dataset.json").read_text())["drive"]
        frames = np.genfromtxt(self.plain / "frames.csv", delimiter=",", names=True)
        for frame, (_, sample) in zip(frames, self.samples):
            sample = json.loads(sample["json"])
            self.assertEqual((sample["drive"], sample["seed"], sample["step"], sample["late_s"]),
                             ("ball_circle", 3, frame["step"], 0))
            self.assertAlmostEqual(sample["t_s"], frame["t_s"], delta=1e-9)
            for key in ("rig", "believed_rig", "encoding"):
                self.assertEqual(sample[key], told[key])
            c, s = np.cos(frame["theta_rad"]), np.sin(frame["theta_rad"])
            robot = np.array([[c, -s, 0, frame["x_m"]], [s, c, 0, frame["y_m"]], [0, 0, 1, 0], [0, 0, 0, 1]])
            self.assertTrue(np.allclose(sample["world_from_robot"], robot, rtol=0, atol=1e-12))
            for side in ("left", "right"):
                wanted = robot @ matrix(rig, f"robot_from_{side}_camera")
                self.assertTrue(np.allclose(sample[f"world_from_{side}_camera"], wanted, rtol=0, atol=1e-12))

    def test_balls(self):
        balls = np.genfromtxt(self.plain / "balls.csv", delimiter=",", names=True)
        count = 0
        for step, (_, sample) in zip(self.steps(), self.samples):
            sample = json.loads(sample["json"])
            ids = {side: cv2.imread(str(self.plain / f"{side}_id" / f"{step}.png"), cv2.IMREAD_UNCHANGED)
                   for side in ("left", "right")}
            seen = sorted(set(np.unique(ids["left"])) | set(np.unique(ids["right"])))
            self.assertEqual([ball["ball_id"] for ball in sample["balls"]], [int(k) - 1 for k in seen if k > 0])
            for ball in sample["balls"]:
                row = balls[ball["ball_id"]]
                centre = np.array([row["x_m"], row["y_m"], row["z_m"]])
                self.assertEqual((ball["colour"], ball["radius_m"]), (row["colour"], row["radius_m"]))
                self.assertTrue(np.array_equal(ball["centre_in_world_m"], centre))
                for side in ("left", "right"):
                    camera = np.linalg.inv(np.array(sample[f"world_from_{side}_camera"]))
                    self.assertTrue(np.allclose(ball[side]["centre_in_camera_m"], (camera @ [*centre, 1])[:3], atol=1e-9))
                    rows, columns = np.nonzero(ids[side] == ball["ball_id"] + 1)
                    self.assertEqual(ball[side]["px_count_visib"], len(rows))
                    box = [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1] if len(rows) else [-1] * 4
                    self.assertEqual(ball[side]["bbox_visib"], [int(value) for value in box])
                    count += len(rows) > 0
        self.assertGreater(count, 4)


class Shards(unittest.TestCase):
    def test_have_a_fixed_number_of_pairs(self):
        """A drive of small pictures that needs two shards; frames that the shutter lost are in none."""
        render(SOURCE / "assets/scenarios/ball_circle.yaml", folder / "many", "--set", "path.step_s=0.15",
               "--set", "path.laps=0.5", "--set", "rig.width_px=32", "--set", "rig.height_px=24", "--set",
               "rig.focal_px=28", "--set", "shutter.drop_probability=0.1", "--seeds", "0")
        shards = sorted((folder / "many/webdataset").glob("*.tar"))
        self.assertEqual([shard.name for shard in shards], ["ball_circle_0-000000.tar", "ball_circle_0-000001.tar"])
        keys = [[member.name.split(".")[0] for member, _ in files_of(shard)[::3]] for shard in shards]
        taken = sorted(path.stem for path in (folder / "many/plain/left").glob("*.png"))
        self.assertEqual(len(keys[0]), PAIRS_OF_SHARD)
        self.assertEqual(keys[0] + keys[1], [f"ball_circle_0_{step}" for step in taken])
        self.assertLess(len(taken), int(taken[-1]) + 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], warnings="ignore")
