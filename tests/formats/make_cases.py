#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes tests/formats/cases/<case>/{input.*,expected.json}, from the specifications and not with the project's code.

Each expected.json is what is known here before: the truth of the log and what was done to the file. Needs python3 and
the programs lz4 and zstd. Usage: python3 tests/formats/make_cases.py
"""
import bz2
import gzip
import json
import pathlib
import shutil
import sqlite3
import struct
import subprocess
import zlib

ROOT = pathlib.Path(__file__).resolve().parent / "cases"
ROWS = 50
NAMES = ["joint_1", "joint_2"]
SECOND = 10**9
RECEIVED_LATER = 2_000_000  # ns


def stamp(k):
    return SECOND + k * 10_000_000


def position(k):
    return [k / 64.0, -k / 32.0]


def velocity(k):
    return [1.5625, -3.125 + k / 128.0]


def effort(k):
    return [k / 16.0, 2.0 - k / 8.0]


# ---- messages


def cdr(k, names, q, dq, tau, big=False, stamped=True):
    order = ">" if big else "<"
    out = bytearray()

    def align(to):
        out.extend(bytes(-len(out) % to))

    def word(value):
        align(4)
        out.extend(struct.pack(order + "I", value))

    def text(value):
        word(len(value) + 1)
        out.extend(value.encode() + b"\0")

    def numbers(values):
        word(len(values))
        if values:
            align(8)
            out.extend(struct.pack(order + f"{len(values)}d", *values))

    word(stamp(k) // SECOND if stamped else 0)
    word(stamp(k) % SECOND if stamped else 0)
    text("base")
    word(len(names))
    for name in names:
        text(name)
    numbers(q)
    numbers(dq)
    numbers(tau)
    return bytes([0, 0 if big else 1, 0, 0]) + bytes(out)


def ros1(k, names, q, dq, tau):
    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    def numbers(values):
        return struct.pack(f"<I{len(values)}d", len(values), *values)

    head = struct.pack("<III", k, stamp(k) // SECOND, stamp(k) % SECOND) + text("base")
    return head + struct.pack("<I", len(names)) + b"".join(map(text, names)) + numbers(q) + numbers(dq) + numbers(tau)


def as_json(k, names, q, dq, tau):
    head = {"stamp": {"sec": stamp(k) // SECOND, "nsec": stamp(k) % SECOND}, "frame_id": "base"}
    return json.dumps({"header": head, "name": names, "position": q, "velocity": dq, "effort": tau}).encode()


def plain(k, encode=cdr, **more):
    return encode(k, NAMES, position(k), velocity(k), effort(k), **more)


# ---- MCAP

MAGIC = b"\x89MCAP0\r\n"


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def record(op, content):
    return struct.pack("<BQ", op, len(content)) + content


def pack(kind, data):
    if kind == "":
        return data
    return subprocess.run([kind, "-c", "-q"], input=data, capture_output=True, check=True).stdout


class Mcap:
    """topics: (name, type, encoding) by channel number from 1; messages: (channel, receipt, bytes)."""

    def __init__(self, topics, packing="", chunk=20, summary=True, chunked=True, checksum=True):
        self.topics, self.packing, self.chunk, self.summary = topics, packing, chunk, summary
        self.chunked, self.checksum = chunked, checksum
        self.chunks = []  # (offset, length)
        self.spoil_index = 0

    def definitions(self):
        out = b""
        for number, (name, kind, encoding) in enumerate(self.topics, 1):
            out += record(3, struct.pack("<H", number) + text(kind) + text("ros2msg") + text(""))
            out += record(4, struct.pack("<HH", number, number) + text(name) + text(encoding) + text(""))
        return out

    def bytes(self, messages):
        out = MAGIC + record(1, text("") + text("made for a test"))
        if not self.chunked:
            out += self.definitions()
            for number, (channel, time, data) in enumerate(messages):
                out += record(5, struct.pack("<HIQQ", channel, number, time, time) + data)
        else:
            for begin in range(0, len(messages), self.chunk):
                out += self.one_chunk(messages[begin : begin + self.chunk], begin == 0, len(out))
        out += record(15, struct.pack("<I", 0))
        start = len(out)
        if self.summary:
            out += self.definitions()
            counts = b""
            out += record(11, struct.pack("<QHIIIIQQ", len(messages) + self.spoil_index, len(self.topics),
                                          len(self.topics), 0, 0, len(self.chunks), 0, 0) + text(counts.decode()))
            for offset, length in self.chunks:
                out += record(8, struct.pack("<QQQQ", 0, 0, offset + self.spoil_index, length) + struct.pack("<I", 0) +
                              struct.pack("<Q", 0) + text(self.packing) + struct.pack("<QQ", 0, 0))
        out += record(2, struct.pack("<QQI", start if self.summary else 0, 0, 0))
        return out + MAGIC

    def one_chunk(self, messages, first, offset):
        inside = self.definitions() if first else b""
        places = {}
        for number, (channel, time, data) in enumerate(messages):
            places.setdefault(channel, []).append((time, len(inside)))
            inside += record(5, struct.pack("<HIQQ", channel, number, time, time) + data)
        packed = pack(self.packing, inside)
        crc = zlib.crc32(inside) if self.checksum else 0
        times = [m[1] for m in messages]
        chunk = record(6, struct.pack("<QQQI", min(times), max(times), len(inside), crc) + text(self.packing) +
                       struct.pack("<Q", len(packed)) + packed)
        self.chunks.append((offset, len(chunk)))
        index = b"".join(record(7, struct.pack("<HI", channel, 16 * len(entries)) +
                                b"".join(struct.pack("<QQ", *entry) for entry in entries))
                         for channel, entries in places.items())
        return chunk + index


STATES = ("/joint_states", "sensor_msgs/msg/JointState", "cdr")


def messages(encode=plain, rows=ROWS, channel=1):
    return [(channel, stamp(k) + RECEIVED_LATER, encode(k)) for k in range(rows)]


# ---- ROS 1 bag


def fields(**values):
    out = b""
    for name, value in values.items():
        item = name.encode() + b"=" + value
        out += struct.pack("<I", len(item)) + item
    return out


def bag_record(header, data):
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def bag(packing, chunk=20, spoil=None):
    def connection():
        about = fields(topic=b"/joint_states", type=b"sensor_msgs/JointState", md5sum=b"0", message_definition=b"")
        return bag_record(fields(conn=struct.pack("<I", 0), topic=b"/joint_states", op=b"\x07"), about)

    def when(k):
        received = stamp(k) + RECEIVED_LATER
        return struct.pack("<II", received // SECOND, received % SECOND)

    out = b"#ROSBAG V2.0\n"
    head = fields(chunk_count=struct.pack("<I", 3), conn_count=struct.pack("<I", 1), index_pos=struct.pack("<Q", 0),
                  op=b"\x03")
    out += bag_record(head, b" " * (4096 - 8 - len(head)))
    for number, begin in enumerate(range(0, ROWS, chunk)):
        rows = range(begin, min(ROWS, begin + chunk))
        inside = connection() if begin == 0 else b""
        for k in rows:
            inside += bag_record(fields(conn=struct.pack("<I", 0), op=b"\x02", time=when(k)), plain(k, ros1))
        packed = {"none": lambda b: b, "bz2": bz2.compress, "lz4": lambda b: pack("lz4", b)}[packing](inside)
        if spoil == number:
            packed = packed[:200] + bytes(50) + packed[250:]
        out += bag_record(fields(op=b"\x05", compression=packing.encode(), size=struct.pack("<I", len(inside))), packed)
        entries = b"".join(when(k) + struct.pack("<I", 0) for k in rows)
        out += bag_record(fields(op=b"\x04", ver=struct.pack("<I", 1), conn=struct.pack("<I", 0),
                                 count=struct.pack("<I", len(rows))), entries)
    return out


# ---- rosbag2


def database(path, rows=ROWS):
    path.unlink(missing_ok=True)
    db = sqlite3.connect(path)
    db.execute("PRAGMA page_size = 1024")
    db.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
               "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    db.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
               "data BLOB NOT NULL)")
    db.execute("INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '')")
    for k in range(rows):
        db.execute("INSERT INTO messages VALUES(?, 1, ?, ?)", (k + 1, stamp(k) + RECEIVED_LATER, plain(k)))
    db.commit()
    db.close()
    return path.read_bytes()


# ---- text


def csv(rows=ROWS):
    lines = ["t,q1,q2,dq1,dq2,tau1,tau2"]
    for k in range(rows):
        lines.append(",".join(map(repr, [stamp(k) / SECOND] + position(k) + velocity(k) + effort(k))))
    return ("\n".join(lines) + "\n").encode()


# ---- expectations


def row(k):
    names = ["t", "q1", "q2", "dq1", "dq2", "tau1", "tau2"]
    return dict(zip(names, [stamp(k) / SECOND] + position(k) + velocity(k) + effort(k)))


def expected(form, rows=ROWS, first=None, last=None, issues=None, read=None, without=()):
    first, last = first or row(0), last or row(ROWS - 1)
    for values in (first, last):
        for name in without:
            values.pop(name)
    return {"format": form, "rows_read": read or rows, "rows": rows, "joints": 2, "first": first, "last": last,
            "issues": issues or {}}


def write(case, extension, data, want):
    folder = ROOT / case
    folder.mkdir(parents=True)
    (folder / ("input" + extension)).write_bytes(data)
    (folder / "expected.json").write_text(json.dumps(want, indent=2) + "\n")


GAP = {"receipt_gap": 1}


def mcap_cases():
    def case(name, data, **want):
        want["issues"] = GAP | want.get("issues", {})
        write("mcap_" + name, ".mcap", data, expected("mcap", **want))

    for packing in ("", "lz4", "zstd"):
        case(packing or "plain", Mcap([STATES], packing).bytes(messages()))
    case("without_chunks", Mcap([STATES], chunked=False).bytes(messages()))
    case("without_summary", Mcap([STATES], summary=False).bytes(messages()))
    case("big_endian", Mcap([STATES]).bytes(messages(lambda k: plain(k, big=True))))
    case("of_ros1", Mcap([("/joint_states", "sensor_msgs/JointState", "ros1")]).bytes(messages(lambda k: plain(k, ros1))))
    case("json", Mcap([("/joint_states", "sensor_msgs/JointState", "json")]).bytes(messages(lambda k: plain(k, as_json))))
    late_first = messages()
    late_first[3], late_first[4] = late_first[4], late_first[3]
    case("unordered_in_chunk", Mcap([STATES]).bytes(late_first))

    def turned(k):
        if k % 2 == 0:
            return plain(k)
        return cdr(k, NAMES[::-1], position(k)[::-1], velocity(k)[::-1], effort(k)[::-1])

    case("joints_change_order", Mcap([STATES]).bytes(messages(turned)))

    def partly(k):
        if k != 7:
            return plain(k)
        return cdr(k, NAMES[:1], position(k)[:1], velocity(k)[:1], effort(k)[:1])

    case("joint_missing_once", Mcap([STATES]).bytes(messages(partly)), issues={"joint_missing": 1})
    case("without_effort", Mcap([STATES]).bytes(messages(lambda k: cdr(k, NAMES, position(k), velocity(k), []))),
         without=("tau1", "tau2"))
    first, last = row(0), row(ROWS - 1)
    for k, values in ((0, first), (ROWS - 1, last)):
        values["t"] = (stamp(k) + RECEIVED_LATER) / SECOND
    write("mcap_without_stamps", ".mcap", Mcap([STATES]).bytes(messages(lambda k: plain(k, stamped=False))),
          expected("mcap", first=first, last=last, issues={"no_stamps": 1}))
    two = []
    for k in range(ROWS):
        two.append((2, stamp(k), cdr(k, NAMES, [k / 4.0, k / 2.0], [], [])))
        two.append(messages()[k])
    commanded = [STATES, ("/joint_commands", "sensor_msgs/msg/JointState", "cdr")]
    case("commanded_beside", Mcap(commanded, chunk=40).bytes(two),
         first=row(0) | {"q_ref1": 0.0, "q_ref2": 0.0}, last=row(ROWS - 1) | {"q_ref1": 49 / 4.0, "q_ref2": 49 / 2.0})
    arm_and_gripper = []
    for k in range(ROWS):
        arm_and_gripper.append(messages()[k])
        if k % 3 == 0:
            arm_and_gripper.append((1, stamp(k) + 3_000_000, cdr(k, ["finger"], [0.04], [0.0], [1.0])))
    case("gripper_on_same_topic", Mcap([STATES]).bytes(arm_and_gripper))
    restarted = messages()[:30] + [(2, time, data) for _, time, data in messages()[30:]]
    case("topic_of_two_channels", Mcap([STATES, STATES]).bytes(restarted))
    # damage
    whole = Mcap([STATES], "zstd").bytes(messages())
    second = whole.index(b"zstd", whole.index(b"zstd") + 4)
    flipped = bytearray(whole)
    flipped[second + 60] ^= 4
    case("zstd_bit_flipped", bytes(flipped), rows=30, read=50, issues={"chunk_damaged": 1, "messages_lost": 20})
    whole = Mcap([STATES]).bytes(messages())
    inside = whole.index(plain(25)) + 80
    flipped = bytearray(whole)
    flipped[inside] ^= 1
    case("checksum_wrong", bytes(flipped), rows=30, read=50, issues={"chunk_damaged": 1, "messages_lost": 20})
    cut = whole[: whole.index(plain(45)) + 10]
    case("cut", cut, rows=45, last=row(44), issues={"chunk_damaged": 1, "file_truncated": 1})
    lies = Mcap([STATES])
    lies.spoil_index = 5
    case("index_lies", lies.bytes(messages()), issues={"index_wrong": 2})
    unchunked = bytearray(Mcap([STATES], chunked=False).bytes(messages()))
    at = unchunked.index(plain(20)) - 22 - 8
    unchunked[at : at + 8] = struct.pack("<Q", 1 << 60)
    case("length_of_an_exbibyte", bytes(unchunked), rows=49, issues={"records_damaged": 1})
    mixed = Mcap([STATES], chunked=False, summary=False)
    whole = mixed.bytes(messages()[20:])
    at = whole.index(mixed.definitions()) + len(mixed.definitions())
    damaged = bytearray(mixed.one_chunk(messages()[:20], False, 0))
    damaged[damaged.index(plain(5)) + 80] ^= 1
    case("messages_behind_a_damaged_chunk", whole[:at] + bytes(damaged) + whole[at:], rows=30, read=50, first=row(20),
         issues={"chunk_damaged": 1, "messages_lost": 20})
    bomb = Mcap([STATES], "zstd").bytes(messages())
    at = bomb.index(b"zstd") - 4 - 4 - 8
    bomb = bomb[:at] + struct.pack("<Q", 1 << 60) + bomb[at + 8 :]
    write("mcap_bomb", ".mcap", bomb, expected("mcap", rows=30, read=50, first=row(20), issues=GAP | {
        "chunk_damaged": 1, "messages_lost": 20}))
    write("mcap_of_other_messages", ".mcap", Mcap([("/image", "sensor_msgs/msg/Image", "cdr")]).bytes(messages()),
          {"error": ["no message with joint states", "/image"]})


def rosbag_cases():
    for packing in ("none", "lz4", "bz2"):
        write("rosbag1_" + packing, ".bag", bag(packing), expected("rosbag1", issues=GAP))
    write("rosbag1_chunk_damaged", ".bag", bag("bz2", spoil=1),
          expected("rosbag1", rows=30, read=50, issues=GAP | {"chunk_damaged": 1, "messages_lost": 20}))
    whole = bag("none")
    write("rosbag1_cut", ".bag", whole[: whole.index(plain(45, ros1)) + 3],
          expected("rosbag1", rows=45, last=row(44), issues=GAP | {"chunk_damaged": 1}))
    scratch = ROOT / "scratch.db3"
    db = database(scratch)
    write("rosbag2_sqlite", ".db3", db, expected("rosbag2", issues=GAP))
    page = 1024
    at = db.index(plain(25)) // page * page
    lost = sum(1 for k in range(ROWS) if at <= db.index(plain(k)) < at + page)
    write("rosbag2_page_zeroed", ".db3", db[:at] + bytes(page) + db[at + page :],
          expected("rosbag2", rows=ROWS - lost, issues=GAP | {"pages_damaged": 1}))
    scratch.unlink()


def table(header, cells):
    return ("\n".join([header] + [",".join(row) for row in cells]) + "\n").encode()


def numbers(values):
    return [repr(float(value)) for value in values]


def at_epoch(base):
    """The first and last row of a log whose clock counts from 1970."""
    first, last = row(0), row(ROWS - 1)
    for k, values in ((0, first), (ROWS - 1, last)):
        values["t"] = base + k / 4
    return {"first": first, "last": last}


def dialect_cases():
    names = "q1,q2,dq1,dq2,tau1,tau2"
    base = 1777636800  # 2026-05-01 12:00 UTC

    def values(k):
        return numbers(position(k) + velocity(k) + effort(k))

    def clock(k, form):
        seconds = k // 4
        return form.format(12 + seconds // 3600, seconds // 60, seconds % 60, 250 * (k % 4))

    iso = [[clock(k, "2026-05-01T{:02}:{:02}:{:02}.{:03}Z")] + values(k) for k in range(ROWS)]
    write("csv_iso_time", ".csv", table("timestamp," + names, iso), expected("csv", **at_epoch(base)))
    iso = [[clock(k, "2026-05-01 {:02}:{:02}:{:02}.{:03}000+02:00")] + values(k) for k in range(ROWS)]
    write("csv_iso_time_of_a_zone", ".csv", table("time," + names, iso), expected("csv", **at_epoch(base - 7200)))
    day = [[clock(k, "{:02}:{:02}:{:02}.{:03}")] + values(k) for k in range(ROWS)]
    write("csv_time_of_day", ".csv", table("Time," + names, day), expected("csv", **at_epoch(12 * 3600)))
    for unit, factor in (("ms", 10**3), ("us", 10**6), ("ns", 10**9)):
        rows = [[str((base * 4 + k) * factor // 4)] + values(k) for k in range(ROWS)]
        write("csv_epoch_" + unit, ".csv", table("timestamp," + names, rows), expected("csv", **at_epoch(base)))
    rows = [[repr(stamp(k) / SECOND)] + values(k) for k in range(ROWS)]
    two = "time,Joint 1,,,Joint 2,,\n,pos,vel,torque,pos,vel,torque"
    mixed = [[r[0], r[1], r[3], r[5], r[2], r[4], r[6]] for r in rows]
    write("csv_two_header_lines", ".csv", table(two, mixed), expected("csv"))
    french = "temps [secondes],q1 [radianes],q2 [rad],dq1 [rad/s],dq2 [rads-1],tau1 [N·m],tau2 [N-m]"
    write("csv_units_of_other_languages", ".csv", table(french, rows), expected("csv"))
    echo = b""
    for k in range(ROWS):
        head = [str(base + k // 4), str(250000000 * (k % 4)), "base"] + NAMES
        echo += ",".join(head + values(k)).encode() + b"\n"
    text_cells = {"no_header": 1, "not_a_number": 3 * ROWS}
    first, last = at_epoch(base)["first"], at_epoch(base)["last"]
    for k, values_there in ((0, first), (ROWS - 1, last)):
        values_there["t"] = float(base + k // 4) + 1e-9 * (250000000 * (k % 4))
    want = expected("csv", first=first, last=last, issues=text_cells)
    write("csv_ros2_topic_echo", ".csv", echo, want)
    sparse = []
    for k in range(ROWS):
        q, dq, tau = numbers(position(k)), numbers(velocity(k)), numbers(effort(k))
        sparse.append([repr(stamp(k) / SECOND - 0.004), "", "", "", ""] + tau)
        sparse.append([repr(stamp(k) / SECOND)] + q + dq + ["", ""])
    write("csv_sparse_cells", ".csv", table("__time," + names, sparse),
          expected("csv", read=2 * ROWS, issues={"row_of_other_signals": ROWS}))


def packed_cases():
    whole = csv()
    write("csv_gzip", ".csv.gz", gzip.compress(whole, mtime=0), expected("csv"))
    half = len(whole) // 2
    write("csv_gzip_two_members", ".csv.gz", gzip.compress(whole[:half], mtime=0) + gzip.compress(whole[half:], mtime=0),
          expected("csv"))
    write("csv_zstd", ".csv.zst", pack("zstd", whole), expected("csv"))
    cut = gzip.compress(whole, mtime=0)
    write("csv_gzip_end_missing", ".csv.gz", cut[:-4], expected("csv", issues={"compression_damaged": 1}))


def main():
    shutil.rmtree(ROOT, ignore_errors=True)
    mcap_cases()
    rosbag_cases()
    packed_cases()
    dialect_cases()


main()
