"""Bags of ROS 1 through Debian's python3-rosbag, beside the plain data set.

usage: rosbag_test.py STEREOBENCH SOURCE_DIR; exits with 77 (skipped) without rosbag or OpenCV. What ros_facts.py is
meant to catch, and: an index that leads elsewhere; a definition that is not of its md5.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
try:
    import genpy
    import rosbag
    import ros_facts
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(77)

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])


def setUpModule():
    global folder, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    subprocess.run([STEREOBENCH, "render", SOURCE / "assets/scenarios/ball_circle.yaml", "--set", "path.laps=0.08",
                    "--seeds", "3", "--set", "rig.pitch_down_deg=4", "--set", "camera.noise_sd_levels=2",
                    "--format", "plain,rosbag", "--out", folder], check=True, stdout=subprocess.DEVNULL)


def tearDownModule():
    scratch.cleanup()


class Rosbag(ros_facts.RosFacts, unittest.TestCase):
    def setUp(self):
        self.plain = folder / "plain"
        self.bag = rosbag.Bag(str(folder / "rosbag/ball_circle_3.bag"))
        self.messages = [(topic, time.to_nsec(), message) for topic, message, time in self.bag.read_messages()]

    def tearDown(self):
        self.bag.close()

    def stamp_ns(self, header):
        return header.stamp.to_nsec()

    def test_facts_of_the_file(self):
        types, topics = self.bag.get_type_and_topic_info()
        self.assertEqual({name: info.msg_type for name, info in topics.items()}, ros_facts.TOPICS)
        self.assertEqual(sum(info.message_count for info in topics.values()), len(self.messages))
        self.assertEqual((self.bag.version, self.bag.get_compression_info().compression), (200, "none"))
        self.assertEqual(self.bag.get_start_time(), 1.5e9)
        for connection in self.bag._get_connections():
            types = genpy.dynamic.generate_dynamic(connection.datatype, connection.msg_def)
            self.assertEqual(types[connection.datatype]._md5sum, connection.md5sum, connection.datatype)
            self.assertEqual(connection.header.get("latching"), b"1" if connection.topic in ros_facts.LATCHED else None)

    def test_index(self):
        """Messages are found by topic and time, without those before."""
        late = [entry for entry in self.messages if entry[1] > ros_facts.EPOCH_NS]
        found = [(topic, time.to_nsec(), message) for topic, message, time in
                 self.bag.read_messages(start_time=genpy.Time(1_500_000_000, 1))]
        self.assertEqual(found, late)
        for topic in ros_facts.TOPICS:
            found = [(name, time.to_nsec(), message) for name, message, time in self.bag.read_messages(topics=[topic])]
            self.assertEqual(found, [entry for entry in self.messages if entry[0] == topic])


# What MRPT is to take from a bag. Its pictures are left out: rosbag2rawlog 2.5.8 ends in its own gzwrite with every bag
# of pictures, one that Debian's rosbag wrote as well.
MRPT_SENSORS = """
sensors:
  landmarks: {type: CObservationPointCloud, topic: /ground_truth/landmarks, fixed_sensor_pose: "0 0 0 0 0 0"}
  sightings: {type: CObservationPointCloud, topic: /sightings, fixed_sensor_pose: "0 0 0 0 0 0"}
"""


@unittest.skipUnless(shutil.which("rosbag2rawlog"), "rosbag2rawlog is missing (apt-get install mrpt-apps)")
class Mrpt(unittest.TestCase):
    def test_clouds_are_read(self):
        """Red where clouds have no x, y and z of 32 bits: MRPT leaves them out then."""
        bag = folder / "rosbag/ball_circle_3.bag"
        (folder / "sensors.yaml").write_text(MRPT_SENSORS)
        subprocess.run(["rosbag2rawlog", "-w", "-f", "map", "-c", folder / "sensors.yaml", "-o", folder / "out.rawlog", bag],
                       check=True, stdout=subprocess.DEVNULL)
        said = subprocess.run(["rawlog-edit", "--info", "-i", folder / "out.rawlog"], check=True, capture_output=True,
                              text=True).stdout
        with rosbag.Bag(str(bag)) as opened:
            topics = opened.get_type_and_topic_info().topics
        for label, topic in (("landmarks", "/ground_truth/landmarks"), ("sightings", "/sightings")):
            count = re.search(rf"\b{label} /\s+(\d+) /", said)
            self.assertIsNotNone(count, said)
            self.assertEqual(int(count.group(1)), topics[topic].message_count, label)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], warnings="ignore")
