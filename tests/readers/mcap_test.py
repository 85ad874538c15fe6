"""Recordings as MCAP, beside the plain data set: a reader written from the specification (mcap.dev/spec) and from that
of CDR (OMG CORBA 3.3, part 2, 9.3), which is told nothing but what the file says.

usage: mcap_test.py STEREOBENCH SOURCE_DIR; exits with 77 (skipped) without OpenCV. What ros_facts.py is meant to catch,
and: values that are not aligned; strings without their zero; a schema that is not of its messages; counts, places and
checksums that are wrong.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import types
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).parent))
try:
    import ros_facts
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(77)

STEREOBENCH, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, STATISTICS, SUMMARY_OFFSET, DATA_END = 1, 2, 3, 4, 5, 11, 14, 15
PRIMITIVES = {"bool": "?", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
              "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


class Bytes:
    """Little-endian values, one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        if self.at + size > len(self.data):
            raise ValueError(f"{size} bytes at {self.at} of {len(self.data)}")
        self.at += size
        return self.data[self.at - size:self.at]

    def number(self, code):
        return struct.unpack("<" + code, self.take(struct.calcsize("<" + code)))[0]

    def text(self):
        return self.take(self.number("I")).decode()

    def mapping(self, key, value):
        inner, found = Bytes(self.take(self.number("I"))), {}
        while inner.at < len(inner.data):
            name = key(inner)
            found[name] = value(inner)
        return found


class Cdr(Bytes):
    """A value begins at a multiple of its size, counted from behind the four bytes that say which CDR it is."""

    def __init__(self, data):
        super().__init__(data)
        if self.take(4) != b"\0\1\0\0":
            raise ValueError("expected plain CDR, little endian")

    def align(self, size):
        self.take(-(self.at - 4) % size)

    def primitive(self, name):
        if name == "string":
            self.align(4)
            text = self.take(self.number("I"))
            if text[-1:] != b"\0":
                raise ValueError("a string without its zero")
            return text[:-1].decode()
        code = PRIMITIVES[name]
        self.align(struct.calcsize(code))
        return self.number(code)


def fields_of(definition):
    """Field lists of a schema (ros2msg) by the names of types; the message's own has the name None."""
    parts, name = {None: []}, None
    for line in definition.splitlines():
        if line.startswith("MSG: "):
            name = line.removeprefix("MSG: ")
            parts[name] = []
        elif line and line != "=" * 80:
            kind, field = line.split(" ", 1)
            if "=" not in field:
                parts[name].append((kind, field))
    return parts


def decode(cdr, parts, kind):
    if kind in PRIMITIVES or kind == "string":
        return cdr.primitive(kind)
    if kind is not None and kind.endswith("]"):
        element, count = kind[:-1].split("[")
        if not count:
            cdr.align(4)
        length = int(count) if count else cdr.number("I")
        if element == "uint8":
            return cdr.take(length)
        return [decode(cdr, parts, element) for _ in range(length)]
    return types.SimpleNamespace(**{field: decode(cdr, parts, inner) for inner, field in parts[kind]})


def records_of(data, start, end):
    """(place, opcode, content) of each record between two places."""
    while start < end:
        size = struct.unpack_from("<Q", data, start + 1)[0]
        yield start, data[start], data[start + 9:start + 9 + size]
        start += 9 + size
    if start != end:
        raise ValueError(f"a record ends at {start}, not at {end}")


def read_schema(content):
    data = Bytes(content)
    return data.number("H"), (data.text(), data.text(), data.text())


def read_channel(content):
    data = Bytes(content)
    return data.number("H"), (data.number("H"), data.text(), data.text(), data.mapping(Bytes.text, Bytes.text))


def setUpModule():
    global folder, scratch
    scratch = tempfile.TemporaryDirectory()
    folder = pathlib.Path(scratch.name)
    subprocess.run([STEREOBENCH, "render", SOURCE / "assets/scenarios/ball_circle.yaml", "--set", "path.laps=0.08",
                    "--seeds", "3", "--set", "rig.pitch_down_deg=4", "--format", "plain,mcap", "--out", folder],
                   check=True, stdout=subprocess.DEVNULL)


def tearDownModule():
    scratch.cleanup()


class Mcap(ros_facts.RosFacts, unittest.TestCase):
    def setUp(self):
        self.plain = folder / "plain"
        self.data = (folder / "mcap/ball_circle_3.mcap").read_bytes()
        self.records = list(records_of(self.data, len(MAGIC), len(self.data) - len(MAGIC)))
        self.data_records = self.records[:[op for _, op, _ in self.records].index(DATA_END)]
        self.schemas = dict(read_schema(content) for _, op, content in self.data_records if op == SCHEMA)
        self.channels = dict(read_channel(content) for _, op, content in self.data_records if op == CHANNEL)
        self.messages, self.counts = [], {channel: 0 for channel in self.channels}
        for _, op, content in self.data_records:
            if op != MESSAGE:
                continue
            head = Bytes(content)
            channel, sequence, log_time, publish_time = (head.number(code) for code in "HIQQ")
            self.assertEqual((sequence, publish_time), (self.counts[channel], log_time))
            self.counts[channel] += 1
            schema, topic, _, _ = self.channels[channel]
            parts = fields_of(self.schemas[schema][2])
            cdr = Cdr(content[head.at:])
            self.messages.append((topic, log_time, decode(cdr, parts, None)))
            self.assertEqual(cdr.at, len(cdr.data), topic)

    def stamp_ns(self, header):
        return header.stamp.sec * 10**9 + header.stamp.nanosec

    def test_header_schemas_and_channels(self):
        self.assertEqual((self.data[:8], self.data[-8:]), (MAGIC, MAGIC))
        _, op, content = self.records[0]
        self.assertEqual((op, Bytes(content).text()), (HEADER, "ros2"))
        for name, encoding, _ in self.schemas.values():
            self.assertEqual(encoding, "ros2msg", name)
        found = {topic: self.schemas[schema][0] for schema, topic, _, _ in self.channels.values()}
        self.assertEqual(found, {topic: name.replace("/", "/msg/") for topic, name in ros_facts.TOPICS.items()})
        for _, _, encoding, metadata in self.channels.values():
            self.assertEqual((encoding, list(metadata)), ("cdr", ["offered_qos_profiles"]))
        self.assertNotIn(0, self.schemas)

    def test_summary(self):
        end = len(self.data_records)
        place, _, content = self.records[end]
        self.assertEqual(Bytes(content).number("I"), zlib.crc32(self.data[:place]))
        footer_place, op, content = self.records[-1]
        self.assertEqual(op, FOOTER)
        summary_start, offsets_start, checksum = struct.unpack("<QQI", content)
        self.assertEqual(summary_start, self.records[end + 1][0])
        self.assertEqual(checksum, zlib.crc32(self.data[summary_start:footer_place + 9 + 16]))
        summary = list(records_of(self.data, summary_start, offsets_start))
        for op in (SCHEMA, CHANNEL):
            self.assertEqual([content for _, kind, content in summary if kind == op],
                             [content for _, kind, content in self.data_records if kind == op])
        told = Bytes(next(content for _, op, content in summary if op == STATISTICS))
        self.assertEqual([told.number(code) for code in "QHIIIIQQ"],
                         [len(self.messages), len(self.schemas), len(self.channels), 0, 0, 0, self.messages[0][1],
                          self.messages[-1][1]])
        self.assertEqual(told.mapping(lambda data: data.number("H"), lambda data: data.number("Q")), self.counts)
        groups = [struct.unpack("<BQQ", content) for _, op, content in
                  records_of(self.data, offsets_start, footer_place) if op == SUMMARY_OFFSET]
        self.assertEqual([group for group, _, _ in groups], [SCHEMA, CHANNEL, STATISTICS])
        for group, start, length in groups:
            self.assertEqual({op for _, op, _ in records_of(self.data, start, start + length)}, {group})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], warnings="ignore")
