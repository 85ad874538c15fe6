"""What recordings of a drive must hold, by the plain data set beside them: the same of ROS 1 and of ROS 2.

A message is an object with the fields of its type. Meant to catch: P[3] of the wrong sign; the left camera's pictures
for the right one's; stamps that differ; truth for the measured odometry; hidden balls; bearings to the right.
"""

import collections
import csv
import math

import cv2
import numpy as np

EPOCH_NS = 1_500_000_000 * 10**9
TOPICS = {
    "/tf_static": "tf2_msgs/TFMessage", "/tf": "tf2_msgs/TFMessage", "/odom": "nav_msgs/Odometry",
    "/ground_truth/pose": "geometry_msgs/PoseStamped", "/stereo/left/image_raw": "sensor_msgs/Image",
    "/stereo/right/image_raw": "sensor_msgs/Image", "/stereo/left/camera_info": "sensor_msgs/CameraInfo",
    "/stereo/right/camera_info": "sensor_msgs/CameraInfo", "/detections": "visualization_msgs/MarkerArray",
    "/ground_truth/balls": "visualization_msgs/MarkerArray", "/ground_truth/pose_2d": "geometry_msgs/Pose2D",
    "/ground_truth/landmarks": "sensor_msgs/PointCloud2", "/sightings": "sensor_msgs/PointCloud2"}
LATCHED = ("/tf_static", "/ground_truth/landmarks")
FLOAT32, FLOAT64 = 7, 8


def table(plain, name):
    with open(plain / name, newline="") as file:
        return list(csv.DictReader(file))


def nanoseconds(text):
    seconds, fraction = text.split(".")
    return int(seconds) * 10**9 + int(fraction)


def place(pose):
    """Where a geometry_msgs/Pose or Transform is, as 4 x 4."""
    at = pose.position if hasattr(pose, "position") else pose.translation
    q = pose.orientation if hasattr(pose, "orientation") else pose.rotation
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), at.x],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), at.y],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), at.z], [0, 0, 0, 1]])


def robot(x, y, heading):
    c, s = math.cos(heading), math.sin(heading)
    return np.array([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])


def points(cloud):
    """The numbers of a sensor_msgs/PointCloud2, x, y and z of 32 bits, all others of 64: a dictionary a point."""
    assert (cloud.height, cloud.is_bigendian, cloud.is_dense) == (1, False, True)
    assert len(cloud.data) == cloud.row_step == cloud.width * cloud.point_step
    types = [(field.datatype, field.count) for field in cloud.fields]
    assert types == [(FLOAT32, 1)] * 3 + [(FLOAT64, 1)] * (len(types) - 3)
    return [{field.name: float(np.frombuffer(cloud.data, "<f4" if field.datatype == FLOAT32 else "<f8", 1,
                                             point * cloud.point_step + field.offset)[0])
             for field in cloud.fields} for point in range(cloud.width)]


def numbers(cloud):
    """The same without x, y and z."""
    return [{name: value for name, value in point.items() if name not in ("x", "y", "z")} for point in points(cloud)]


class RosFacts:
    """For a unittest.TestCase that has `plain`, a folder, and `messages`, in their order: (topic, ns, message)."""

    def stamp_ns(self, header):
        raise NotImplementedError

    def of(self, topic):
        return [(ns - EPOCH_NS, message) for name, ns, message in self.messages if name == topic]

    def steps(self):
        return [row for row in table(self.plain, "frames.csv") if row["has_pictures"] == "1"]

    def close(self, found, wanted):
        self.assertTrue(np.allclose(found, wanted, rtol=0, atol=1e-12), f"{found}\n{wanted}")

    def test_times(self):
        times = [ns for _, ns, _ in self.messages]
        self.assertEqual(times, sorted(times))
        self.assertEqual({name for name, _, _ in self.messages}, set(TOPICS))
        sequences = collections.Counter()
        for name, ns, message in self.messages:
            headers = [message.header] if hasattr(message, "header") else [
                entry.header for entry in getattr(message, "transforms", None) or getattr(message, "markers", [])]
            for header in headers:
                self.assertEqual(self.stamp_ns(header), ns, name)
                if hasattr(header, "seq"):
                    self.assertEqual(header.seq, sequences[name])
            sequences[name] += 1

    def test_pictures(self):
        taken = self.steps()
        self.assertGreaterEqual(len(taken), 3)
        for side in ("left", "right"):
            found = self.of(f"/stereo/{side}/image_raw")
            self.assertEqual([ns for ns, _ in found], [nanoseconds(row["t_s"]) for row in taken])
            for row, (_, image) in zip(taken, found):
                wanted = cv2.imread(str(self.plain / side / f"{int(row['step']):06}.png"))
                self.assertEqual((image.height, image.width, image.encoding, image.step, image.is_bigendian),
                                 (*wanted.shape[:2], "bgr8", 3 * wanted.shape[1], 0))
                self.assertEqual(image.header.frame_id, f"{side}_camera_optical")
                self.assertTrue(np.array_equal(np.frombuffer(image.data, np.uint8).reshape(wanted.shape), wanted))

    def test_cameras(self):
        rig = cv2.FileStorage(str(self.plain / "true_calibration.yaml"), cv2.FILE_STORAGE_READ)
        for side, projection in (("left", "P1"), ("right", "P2")):
            found = self.of(f"/stereo/{side}/camera_info")
            self.assertEqual([ns for ns, _ in found], [ns for ns, _ in self.of(f"/stereo/{side}/image_raw")])
            for _, info in found:
                d, k, r, p = (getattr(info, name, None) or getattr(info, name.lower()) for name in "DKRP")
                self.assertEqual((info.width, info.height, info.distortion_model, info.binning_x, info.roi.width),
                                 (int(rig.getNode("image_width").real()), int(rig.getNode("image_height").real()),
                                  "plumb_bob", 0, 0))
                self.close(np.reshape(k, (3, 3)), rig.getNode("K").mat())
                self.close(np.reshape(p, (3, 4)), rig.getNode(projection).mat())
                self.close(np.reshape(r, (3, 3)), np.eye(3))
                self.assertEqual(list(d), [0] * 5)
        self.assertLess(p[3], 0)
        (ns, cameras), = self.of("/tf_static")
        self.assertEqual(ns, self.messages[0][1] - EPOCH_NS)
        for side, transform in zip(("left", "right"), cameras.transforms):
            self.assertEqual((transform.header.frame_id, transform.child_frame_id),
                             ("base_link", f"{side}_camera_optical"))
            self.close(place(transform.transform), rig.getNode(f"robot_from_{side}_camera").mat())

    def test_truth(self):
        truth = table(self.plain, "groundtruth.csv")
        poses, moves = self.of("/ground_truth/pose"), self.of("/tf")
        self.assertEqual([ns for ns, _ in poses], [nanoseconds(row["t_s"]) for row in truth])
        self.assertEqual([ns for ns, _ in moves], [ns for ns, _ in poses])
        for row, (_, pose), (_, move) in zip(truth, poses, moves):
            wanted = robot(*(float(row[key]) for key in ("x_m", "y_m", "theta_rad")))
            transform, = move.transforms
            self.assertEqual((pose.header.frame_id, transform.header.frame_id, transform.child_frame_id),
                             ("map", "map", "base_link"))
            self.close(place(pose.pose), wanted)
            self.close(place(transform.transform), wanted)

    def test_odometry(self):
        readings, truth = table(self.plain, "odometry.csv"), table(self.plain, "groundtruth.csv")
        begins = [nanoseconds(row["t_s"]) for row in readings] + [nanoseconds(truth[-1]["t_s"])]
        found = self.of("/odom")
        self.assertEqual([ns for ns, _ in found], begins)
        x, y, heading = (float(truth[0][key]) for key in ("x_m", "y_m", "theta_rad"))
        speeds = [(0.0, 0.0)]
        wanted = [robot(x, y, heading)]
        for row, begin, end in zip(readings, begins, begins[1:]):
            v, w, s = float(row["v_mps"]), float(row["w_radps"]), (end - begin) * 1e-9
            x += v / w * (math.sin(heading + w * s) - math.sin(heading))
            y -= v / w * (math.cos(heading + w * s) - math.cos(heading))
            heading += w * s
            speeds.append((v, w))
            wanted.append(robot(x, y, heading))
        for (_, odometry), pose, (v, w) in zip(found, wanted, speeds):
            self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_link"))
            self.close(place(odometry.pose.pose), pose)
            twist = odometry.twist.twist
            self.assertEqual((twist.linear.x, twist.angular.z), (v, w))
            self.assertEqual((twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y), (0, 0, 0, 0))
            self.assertEqual([*odometry.pose.covariance, *odometry.twist.covariance], [0] * 72)

    def test_log(self):
        """What no usual message carries exactly: the numbers of the plain log, to the last bit."""
        truth = [(nanoseconds(row["t_s"]), *(float(row[key]) for key in ("x_m", "y_m", "theta_rad")))
                 for row in table(self.plain, "groundtruth.csv")]
        self.assertEqual([(ns, pose.x, pose.y, pose.theta) for ns, pose in self.of("/ground_truth/pose_2d")], truth)
        seen = [{"ns": ns, **point} for ns, cloud in self.of("/sightings") for point in numbers(cloud)]
        wanted = [{"ns" if key == "t_s" else key: nanoseconds(text) if key == "t_s" else float(text)
                   for key, text in row.items()} for row in table(self.plain, "observations.csv")]
        self.assertEqual(seen, wanted)
        self.assertGreater(len(seen), 0)
        self.assertEqual({cloud.header.frame_id for _, cloud in self.of("/sightings")}, {"base_link"})
        (ns, landmarks), = self.of("/ground_truth/landmarks")
        self.assertEqual((ns, landmarks.header.frame_id), (self.messages[0][1] - EPOCH_NS, "map"))
        self.assertEqual(numbers(landmarks), [{key: float(text) for key, text in row.items()}
                                              for row in table(self.plain, "landmarks.csv")])

    def test_clouds_are_seen_where_things_are(self):
        """Viewers look for x, y and z of 32 bits. Red where y is to the right, and where a sighting has its range as x."""
        (_, landmarks), = self.of("/ground_truth/landmarks")
        for point in points(landmarks):
            self.assertEqual([point["x"], point["y"], point["z"]], [np.float32(point["x_m"]), np.float32(point["y_m"]), 0])
        for _, cloud in self.of("/sightings"):
            for point in points(cloud):
                self.assertAlmostEqual(math.hypot(point["x"], point["y"]), point["range_m"], delta=1e-6)
                self.assertAlmostEqual(math.atan2(point["y"], point["x"]), point["bearing_rad"], delta=1e-6)
                self.assertEqual(point["z"], 0)

    def test_balls(self):
        balls, seen = table(self.plain, "balls.csv"), table(self.plain, "observations.csv")
        detections, truths = self.of("/detections"), self.of("/ground_truth/balls")
        taken = self.steps()
        self.assertEqual([ns for ns, _ in detections], [nanoseconds(row["t_s"]) for row in taken])
        self.assertEqual([ns for ns, _ in truths], [ns for ns, _ in detections])
        for row, (_, detected), (_, true) in zip(taken, detections, truths):
            rows = [sighting for sighting in seen if sighting["t_s"] == row["t_s"]]
            self.assertEqual(len(detected.markers), len(rows))
            for sighting, marker in zip(rows, detected.markers):
                r, b = float(sighting["range_m"]), float(sighting["bearing_rad"])
                at = marker.pose.position
                self.close((at.x, at.y, at.z), (r * math.cos(b), r * math.sin(b), 0))
                self.assertEqual((marker.ns, marker.type, marker.action, marker.header.frame_id),
                                 (f"ball_{sighting['colour_class']}", 2, 0, "base_link"))
            ids = set()
            for side in ("left", "right"):
                ids |= set(np.unique(cv2.imread(str(self.plain / f"{side}_id" / f"{int(row['step']):06}.png"),
                                                cv2.IMREAD_UNCHANGED)).tolist())
            self.assertEqual([marker.id for marker in true.markers], [number - 1 for number in sorted(ids - {0})])
            for marker in true.markers:
                ball, at = balls[marker.id], marker.pose.position
                self.close((at.x, at.y, at.z), [float(ball[key]) for key in ("x_m", "y_m", "z_m")])
                self.close((marker.scale.x, marker.scale.z), [2 * float(ball["radius_m"])] * 2)
                self.assertTrue(np.allclose([marker.color.r, marker.color.g, marker.color.b, marker.color.a],
                                            [float(ball[key]) / 255 for key in ("red", "green", "blue")] + [1]))
                self.assertEqual((marker.ns, marker.header.frame_id), (f"ball_{ball['colour']}", "map"))
        self.assertGreater(sum(len(true.markers) for _, true in truths), 0)
        self.assertGreater(sum(len(detected.markers) for _, detected in detections), 0)
