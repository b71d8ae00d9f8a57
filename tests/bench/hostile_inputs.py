#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes small files that ask for much memory or time, one after the other of each format, into a folder.

Their sizes and places are drawn by the seed. HDF5 files are written by its C library, which the program needs anyway.
Usage: python3 tests/bench/hostile_inputs.py FOLDER SEED
"""
import bz2
import ctypes
import gzip
import os
import random
import sqlite3
import struct
import subprocess
import sys
import zipfile
import zlib

MIB = 1 << 20
LARGEST = 2_000_000  # bytes of a file


def packed(kind, data):
    if kind == "bz2":
        return bz2.compress(data, 9)
    if kind == "gz":
        return gzip.compress(data, 6)
    level = {"zstd": "-6", "lz4": "-9"}[kind]
    extra = ["--content-size"] if kind == "lz4" else []
    return subprocess.run([kind, "-c", "-q", level, *extra], input=data, capture_output=True, check=True).stdout


def text(value):
    value = value if isinstance(value, bytes) else value.encode()
    return struct.pack("<I", len(value)) + value


def joint_state(k, names, values, kind="cdr"):
    """A sensor_msgs/JointState: position, velocity and effort are `values`."""
    if kind == "ros1":
        out = struct.pack("<III", k, 10 + k // 1000, k % 1000 * 10**6) + text("")
        out += struct.pack("<I", len(names)) + b"".join(map(text, names))
        return out + 3 * (struct.pack("<I", len(values)) + struct.pack(f"<{len(values)}d", *values))
    out = bytearray(struct.pack("<II", 10 + k // 1000, k % 1000 * 10**6) + text(b"\0"))
    for value in [len(names), *names]:
        out.extend(bytes(-len(out) % 4))
        out.extend(struct.pack("<I", value) if isinstance(value, int) else text(value.encode() + b"\0"))
    for _ in range(3):
        out.extend(bytes(-len(out) % 4) + struct.pack("<I", len(values)))
        out.extend(bytes(-len(out) % 8) + struct.pack(f"<{len(values)}d", *values))
    return b"\0\1\0\0" + bytes(out)


# ---- MCAP


def record(op, content):
    return struct.pack("<BQ", op, len(content)) + content


def topic(number, name, kind="sensor_msgs/msg/JointState", encoding="cdr"):
    return (record(3, struct.pack("<H", number) + text(kind) + text("ros2msg") + text("")) +
            record(4, struct.pack("<HH", number, number) + text(name) + text(encoding) + text("")))


def message(channel, time, data):
    return record(5, struct.pack("<HIQQ", channel, 0, time, time) + data)


def chunk(kind, inside, size=None, ready=None):
    small = ready if ready is not None else packed(kind, inside)
    return record(6, struct.pack("<QQQI", 0, 1 << 60, size or len(inside), 0) + text(kind) +
                  struct.pack("<Q", len(small)) + small)


def mcap(*parts):
    return (b"\x89MCAP0\r\n" + record(1, text("") + text("")) + b"".join(parts) + record(15, bytes(4)) +
            record(2, bytes(20)) + b"\x89MCAP0\r\n")


def states(rows, first=0, names=("joint_1", "joint_2", "joint_3"), stamped=True):
    return b"".join(message(1, (first + k) * 10**6, joint_state(first + k if stamped else 0, names, [.1] * len(names)))
                    for k in range(rows))


def mcap_cases(draw):
    define = topic(1, "/joint_states")
    few = define + states(50)
    zeros = message(2, 60 * 10**6, bytes(draw.randint(900, 1000) * MIB))
    bomb = topic(2, "/image", "sensor_msgs/msg/Image") + zeros
    yield "mcap_zstd_gigabyte", mcap(few, chunk("zstd", bomb))
    lz4 = chunk("lz4", topic(2, "/image", "x") + message(2, 1, bytes(60 * MIB)))
    yield "mcap_lz4_many", mcap(few, *[lz4] * (LARGEST // len(lz4) - 1))
    del bomb, zeros
    part = chunk("zstd", topic(2, "/image", "x") + message(2, 1, bytes(draw.randint(40, 60) * MIB)))
    yield "mcap_zstd_many", mcap(few, *[part] * (LARGEST // len(part) - 1))
    tiny = chunk("zstd", topic(2, "/image", "x") + message(2, 1, b"") * (60 * MIB // 31))
    yield "mcap_many_small_messages", mcap(few, *[tiny] * 60)
    down = b"".join(message(2, k, b"") for k in range(MIB, 0, -1))
    yield "mcap_unsorted", mcap(few, *[chunk("zstd", topic(2, "/image", "x") + down)] * 3)
    same = chunk("zstd", define + states(1) * (40 * MIB // 200))
    yield "mcap_same_message", mcap(few, *[same] * min(400, LARGEST // len(same) - 1))
    later = b"".join(chunk("zstd", define + states(20000, 20000 * n)) for n in range(8))
    yield "mcap_real_rows", mcap(later[:LARGEST - 1000])
    wide = tuple(f"joint_with_a_long_name_{j}" for j in range(256))
    yield "mcap_wide_rows", mcap(define, *[chunk("zstd", states(2000, 2000 * n, wide)) for n in range(20)])
    new = b"".join(message(1, k, joint_state(k, [f"j{draw.getrandbits(40)}" for _ in range(40)], [0.5] * 40))
                   for k in range(400))
    yield "mcap_new_names", mcap(define, chunk("zstd", new))
    new = b"".join(message(1, k, joint_state(k, [f"j{k}_{j}" for j in range(256)], [0.5] * 256)) for k in range(2000))
    yield "mcap_many_new_names", mcap(define, chunk("zstd", new))
    new = b"".join(message(1, k, joint_state(k, ["x" * 60000 + str(k % 300)], [0.5])) for k in range(500))
    yield "mcap_long_names", mcap(define, *[chunk("zstd", new)] * 40)
    beside = b"".join(message(1, 0, joint_state(k, [f"j{k}_{j}" for j in range(200)], [0.5] * 200)) for k in range(250))
    rows = b"".join(chunk("zstd", states(20000, 20000 * n)) for n in range(6))
    yield "mcap_wide_beside", mcap(define, chunk("zstd", beside), rows[:LARGEST // 2])
    many = b"".join(topic(n, f"/topic_{n}") for n in range(2, 65535))
    yield "mcap_topics", mcap(few, chunk("zstd", many))
    many = b"".join(topic(n, "/" + "n" * 5000 + str(n)) for n in range(2, 65535, 5))
    yield "mcap_long_topics", mcap(few, chunk("zstd", many))
    json = topic(1, "/joint_states", encoding="json")
    yield "mcap_json_list", mcap(chunk("zstd", json + message(1, 1, b'{"name":["a"],"position":[' + b"0," * (25 * MIB) +
                                                             b"0]}")))
    yield "mcap_json_deep", mcap(chunk("zstd", json + message(1, 1, b'{"position":' + b"[" * (30 * MIB))))
    garbage = bytes([5]) * (LARGEST - 4000)
    yield "mcap_garbage", mcap(few)[:-40] + garbage
    yield "mcap_promise", mcap(few, chunk("zstd", b"", size=1 << 60, ready=packed("zstd", bytes(60 * MIB))))
    index = record(7, struct.pack("<H", 1) + text(bytes(1_900_000)))
    damaged = bytearray(chunk("zstd", define + states(50)))
    damaged[-20] ^= 255
    yield "mcap_lost_messages", mcap(define, bytes(damaged), index)


# ---- ROS 1 bag


def fields(**values):
    return b"".join(text(name.encode() + b"=" + value) for name, value in values.items())


def bag_record(header, data):
    return text(header) + text(data)


def connection(number, name, kind=b"sensor_msgs/JointState"):
    about = fields(topic=name, type=kind, md5sum=b"0", message_definition=b"")
    return bag_record(fields(conn=struct.pack("<I", number), topic=name, op=b"\x07"), about)


def bag_message(number, k, data):
    when = struct.pack("<II", 10 + k // 1000, k % 1000 * 10**6)
    return bag_record(fields(conn=struct.pack("<I", number), op=b"\x02", time=when), data)


def bag_states(rows, first=0):
    return b"".join(bag_message(0, first + k, joint_state(first + k, ["joint_1", "joint_2", "joint_3"], [.1, .2, .3], "ros1"))
                    for k in range(rows))


def bag_chunk(kind, inside, size=None):
    small = inside if kind == "none" else packed(kind, inside)
    return bag_record(fields(op=b"\x05", compression=kind.encode(), size=struct.pack("<I", size or len(inside))), small)


def bag(*parts):
    return b"#ROSBAG V2.0\n" + bag_record(fields(op=b"\x03", index_pos=bytes(8)), b" " * 4000) + b"".join(parts)


def bag_cases(draw):
    few = connection(0, b"/joint_states") + bag_states(50)
    image = connection(1, b"/image", b"sensor_msgs/Image")
    for size, times in ((draw.randint(900, 1000), 20), (60, 400)):
        inside = image + bag_message(1, 60, bytes(size * MIB))
        for kind in ("bz2", "lz4"):
            part = bag_chunk(kind, inside)
            yield f"bag_{kind}_{size}", bag(few, *[part] * min(times, LARGEST // len(part) - 1))
    same = bag_chunk("bz2", connection(0, b"/joint_states") + bag_states(1) * 200000)
    yield "bag_same_message", bag(*[same] * 100)
    many = b"".join(connection(n, b"/topic_%d" % n) for n in range(1, 100_000))
    yield "bag_topics", bag(few, bag_chunk("bz2", many))
    yield "bag_topic_per_message", bag(few, bag_chunk("bz2", b"".join(
        connection(n, b"/topic_%d" % n) + bag_message(n, n, joint_state(n, [f"a{n}"], [.5], "ros1"))
        for n in range(1, 50_000))))
    yield "bag_garbage", bag(few) + b"op=" * 600_000
    yield "bag_real_rows", bag(connection(0, b"/joint_states"), *[bag_chunk("bz2", bag_states(20000, 20000 * n))
                                                                 for n in range(5)])


# ---- rosbag2 in SQLite

TOPICS = ("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
          "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
MESSAGES = ("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
            "data BLOB NOT NULL)")


def database(folder, *statements, rows=50, topics=TOPICS, messages=MESSAGES):
    path = os.path.join(folder, "scratch.db3")
    if os.path.exists(path):
        os.remove(path)
    db = sqlite3.connect(path)
    db.execute(topics)
    if topics == TOPICS:
        db.execute("INSERT INTO topics VALUES(1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '')")
    db.execute(messages)
    for k in range(rows):
        values = (k + 1, 1, k * 10**6, joint_state(k, ["joint_1", "joint_2", "joint_3"], [.1, .2, .3]))
        db.execute("INSERT INTO messages(id, topic_id, timestamp, data) VALUES(?, ?, ?, ?)", values)
    for statement in statements:
        db.execute(statement)
    db.commit()
    db.execute("VACUUM")
    db.close()
    with open(path, "rb") as file:
        data = file.read()
    os.remove(path)
    return data


def db3_cases(draw, folder):
    endless = "(WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c WHERE x < 1000000000) SELECT count(*) FROM c)"
    generated = ("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp INTEGER, seed BLOB, "
                 "data BLOB AS (CAST(substr(hex(zeroblob(100000000)), 1, 50) AS BLOB)))")
    more = "INSERT INTO messages(id, topic_id, timestamp) WITH RECURSIVE c(x) AS (SELECT 100 UNION ALL SELECT x + 1 " \
           "FROM c WHERE x < 400) SELECT x, 1, x FROM c"
    yield "db3_generated", database(folder, more, messages=generated, rows=0)
    view = f"CREATE VIEW messages AS SELECT {endless} AS id, 1 AS topic_id, 0 AS timestamp, x'00' AS data"
    yield "db3_view", database(folder, messages=view, rows=0)
    view = f"CREATE VIEW topics AS SELECT 1 AS id, '/a' AS name, 't' || {endless} AS type, 'cdr' AS serialization_format"
    yield "db3_view_topics", database(folder, topics=view)
    long = ("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, extra)")
    add = "ALTER TABLE messages ADD COLUMN data BLOB DEFAULT x'" + "00" * 400_000 + "'"
    rows = "INSERT INTO messages(id, topic_id, timestamp) WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c " \
           "WHERE x < 60000) SELECT x, 1, x FROM c"
    yield "db3_default", database(folder, rows, add, messages=long, rows=0)
    unordered = "CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB)"
    yield "db3_unordered", database(folder, rows, messages=unordered, rows=50)
    many = "INSERT INTO topics WITH RECURSIVE c(x) AS (SELECT 2 UNION ALL SELECT x + 1 FROM c WHERE x < 100000) " \
           "SELECT x, '/' || x, '', '', '' FROM c"
    yield "db3_topics", database(folder, many)[:LARGEST + 1_000_000]
    data = bytearray(database(folder, rows=9000))
    for _ in range(200):
        at = draw.randrange(8, len(data) // 4096) * 4096
        data[at:at + 4096] = bytes(4096)
    yield "db3_pages_zeroed", bytes(data)
    data = bytearray(database(folder, rows=9000))
    for _ in range(2000):
        at = draw.randrange(16384, len(data))
        data[at] = draw.randrange(256)
    yield "db3_bytes_changed", bytes(data)


# ---- HDF5, by its C library


class Hdf5:
    """What is needed of the library to write datasets of doubles."""

    def __init__(self):
        self.lib = ctypes.CDLL("libhdf5_serial.so.103")
        self.lib.H5open()
        for name in ("H5Fcreate", "H5Screate_simple", "H5Pcreate", "H5Dcreate2", "H5Dopen2", "H5Gcreate2"):
            getattr(self.lib, name).restype = ctypes.c_int64
        self.id = lambda name: ctypes.c_int64.in_dll(self.lib, name)

    def file(self, path):
        self.path = path
        self.handle = ctypes.c_int64(self.lib.H5Fcreate(path.encode(), 2, ctypes.c_int64(0), ctypes.c_int64(0)))

    def group(self, name):
        none = ctypes.c_int64(0)
        self.lib.H5Gclose(ctypes.c_int64(self.lib.H5Gcreate2(self.handle, name.encode(), none, none, none)))

    def dataset(self, name, shape, chunk=None, values=None, at=None, deflate=9):
        """Writes `values` (bytes of doubles) at row `at`, everywhere when `at` is None, nowhere when there are none."""
        lib, many = self.lib, ctypes.c_uint64 * len(shape)
        space = ctypes.c_int64(lib.H5Screate_simple(len(shape), many(*shape), None))
        creation = ctypes.c_int64(0)
        if chunk:
            creation = ctypes.c_int64(lib.H5Pcreate(self.id("H5P_CLS_DATASET_CREATE_ID_g")))
            lib.H5Pset_chunk(creation, len(chunk), many(*chunk))
            if deflate:
                lib.H5Pset_deflate(creation, deflate)
        double, none = self.id("H5T_NATIVE_DOUBLE_g"), ctypes.c_int64(0)
        dataset = ctypes.c_int64(lib.H5Dcreate2(self.handle, name.encode(), double, space, none, creation, none))
        assert dataset.value >= 0, name
        memory = ctypes.c_int64(0)
        if values is not None and at is not None:
            count = many(len(values) // 8 // (shape[1] if len(shape) > 1 else 1), *shape[1:])
            memory = ctypes.c_int64(lib.H5Screate_simple(len(shape), count, None))
            lib.H5Sselect_hyperslab(space, 0, many(at, *[0] * (len(shape) - 1)), None, count, None)
        if values is not None:
            where = space if at is not None else none
            assert lib.H5Dwrite(dataset, double, memory, where, none, values) >= 0
        lib.H5Dclose(dataset)

    def bytes(self):
        self.lib.H5Fclose(self.handle)
        with open(self.path, "rb") as file:
            data = file.read()
        os.remove(self.path)
        return data


def doubles(rows, step=0.001, columns=1):
    return struct.pack(f"<{rows * columns}d", *[step * (k // columns) for k in range(rows * columns)])


def h5_cases(draw, folder):
    h5 = Hdf5()
    scratch = os.path.join(folder, "scratch.h5")

    def begin(rows=1000):
        h5.file(scratch)
        if rows:
            h5.dataset("t", [rows], [1000], doubles(rows))
            h5.dataset("q", [rows, 3], [1000, 3], doubles(rows, columns=3))

    huge = 200 * 10**6 // 8
    h5.file(scratch)
    for name in ("t", "q1"):
        h5.dataset(name, [4 * huge], [huge // 50], bytes(32 * huge // 4 * 1), at=0)
    yield "h5_zero_chunks", h5.bytes()
    begin()
    h5.dataset("image", [draw.randint(90, 100) * MIB], [90 * MIB], bytes(720 * MIB), at=0)
    yield "h5_big_chunk_beside", h5.bytes()
    begin()
    for n in range(30):
        h5.dataset(f"image_{n}", [10 * MIB], [10 * MIB], bytes(80 * MIB))
    yield "h5_many_big_beside", h5.bytes()
    for last in (True, False):
        h5.file(scratch)
        rows = 1 << 31
        for name in ("t", "q1"):
            h5.dataset(name, [rows], [1 << 14], doubles(1 << 14), at=rows - (1 << 14) if last else 0)
        yield f"h5_2_31_rows_{'last' if last else 'first'}", h5.bytes()
    h5.file(scratch)
    h5.dataset("t", [20 * MIB], [20 * MIB], bytes(160 * MIB))
    h5.dataset("q", [20 * MIB, 2], [20 * MIB, 1], bytes(320 * MIB))
    yield "h5_one_chunk", h5.bytes()
    begin(0)
    for n in range(5000):
        h5.dataset(f"d{n}", [10])
    yield "h5_datasets", h5.bytes()[:LARGEST]
    h5.file(scratch)
    path = ""
    for n in range(30):
        path += "/" + "g" * 30000
        h5.group(path)
    for n in range(800):
        h5.dataset(path + f"/{n}", [10])
    yield "h5_long_paths", h5.bytes()
    h5.file(scratch)
    h5.dataset("t", [3000], [3000], doubles(3000))
    h5.dataset("q", [3000, 16000], [3000, 250], bytes(8 * 3000 * 16000))
    yield "h5_wide", h5.bytes()


# ---- MATLAB 5 and NumPy


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(name, rows, columns, values):
    content = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", rows, columns))
    return element(14, content + element(1, name.encode()) + element(9, values))


def mat(*matrices):
    return b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x100) + b"IM" + b"".join(
        element(15, zlib.compress(m, 9)) if len(m) > 1000 else m for m in matrices)


def mat_cases(draw):
    rows = draw.randint(15, 18) * MIB
    yield "mat_zeros", mat(matrix("t", rows, 1, bytes(8 * rows)), matrix("q", rows, 1, bytes(8 * rows)))
    yield "mat_wide", mat(matrix("t", 3000, 1, doubles(3000)), matrix("q", 3000, 16000, bytes(8 * 3000 * 16000)))
    yield "mat_big_beside", mat(matrix("t", 1000, 1, doubles(1000)), matrix("q", 1000, 3, bytes(24000)),
                                matrix("image", 40 * MIB, 3, bytes(960 * MIB)))
    nested = matrix("x", 1, 1, bytes(8))
    for _ in range(2000):
        nested = element(14, element(6, struct.pack("<II", 1, 0)) + element(5, struct.pack("<ii", 1, 1)) +
                         element(1, b"c") + nested)
    yield "mat_nested", mat(nested)


def npy(shape, data, kind="<f8"):
    head = f"{{'descr': {kind if kind.startswith('[') else repr(kind)}, 'fortran_order': False, 'shape': {shape}, }}"
    head = head.encode() + b" " * (-(len(head) + 11) % 64) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(head)) + head + data


def npz_cases(draw, folder):
    scratch = os.path.join(folder, "scratch.npz")

    def npz(**arrays):
        with zipfile.ZipFile(scratch, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as file:
            for name, data in arrays.items():
                file.writestr(name + ".npy", data)
        with open(scratch, "rb") as file:
            data = file.read()
        os.remove(scratch)
        return data

    rows = draw.randint(50, 60) * MIB
    yield "npz_zeros", npz(t=npy((rows,), bytes(8 * rows)), q=npy((rows, 2), bytes(16 * rows)))
    yield "npz_big_beside", npz(t=npy((1000,), doubles(1000)), q=npy((1000, 3), bytes(24000)),
                                image=npy((100 * MIB, 2), bytes(1600 * MIB)))
    header = b"\x93NUMPY\2\0" + struct.pack("<I", 4_000_000) + b"(" * 4_000_000
    yield "npz_long_headers", npz(**{f"a{n}": header for n in range(400)})
    yield "npz_wide", npz(t=npy((3000,), doubles(3000)), q=npy((3000, 16000), bytes(8 * 3000 * 16000)))
    yield "npy_records", npy((1 << 40,), bytes(1000), "[('t', '<f8'), ('q', '<f8', (16000,))]")


# ---- text


def csv(rows, columns=3, step=0.001):
    names = ["t"] + [f"q{j + 1}" for j in range(columns)]
    rest = ",0.125" * columns
    return (",".join(names) + "\n" + "".join(f"{k * step:.3f}{rest}\n" for k in range(rows))).encode()


def text_cases(draw):
    few = csv(50)
    blank = b"\n" * (draw.randint(900, 1000) * MIB)
    yield "csv_gz_blank", packed("gz", few + blank), ".csv.gz"
    yield "csv_zst_blank", packed("zstd", few + blank + few), ".csv.zst"
    del blank
    for kind, ending in (("gz", ".csv.gz"), ("zstd", ".csv.zst")):
        yield f"csv_{ending[-2:]}_same_row", packed(kind, few + b"9,0,0,0\n" * (60 * MIB)), ending
        yield f"csv_{ending[-2:]}_restarts", packed(kind, few + csv(100)[11:] * (400 * MIB // 1800)), ending
        yield f"csv_{ending[-2:]}_long_line", packed(kind, few + b"1" * (500 * MIB)), ending
        yield f"csv_{ending[-2:]}_comments", packed(kind, few + b"#\n" * (200 * MIB)), ending
        yield f"csv_{ending[-2:]}_spaces", packed(kind, few + b" \n" * (200 * MIB)), ending
        yield f"csv_{ending[-2:]}_commas", packed(kind, few + b",,,\n" * (120 * MIB)), ending
        yield f"csv_{ending[-2:]}_texts", packed(kind, few + b"x,y,z,z\n" * (60 * MIB)), ending
        yield f"csv_{ending[-2:]}_headers", packed(kind, few + b"t,q1,q2,q3\n" * (50 * MIB)), ending
    wide = [f"q{j}" for j in range(1, 16000)]
    row = ",".join(["{}"] + ["0"] * 15999) + "\n"
    yield "csv_gz_wide", packed("gz", (",".join(["t"] + wide) + "\n" + "".join(row.format(k) for k in range(15000)))
                                .encode()), ".csv.gz"
    yield "csv_wide_text", (",".join(["t"] + wide) + "\n" + "".join(",".join([str(k)] + ["x"] * 15999) + "\n"
                                                                for k in range(50))).encode(), ".csv"
    yield "csv_wide_short_rows", (",".join(["t"] + wide) + "\n" + "".join(f"{k}\n" for k in range(250_000))).encode(), \
        ".csv"
    yield "csv_gz_wide_sample", packed("gz", b"x" * (4 * MIB) + b"\n" + (",".join(["t"] + wide) + "\n" + row.format(1) * 400)
                                       .encode()), ".csv.gz"
    yield "csv_quotes", few + b'"' * 1_900_000, ".csv"
    yield "csv_short_rows", b"t,q1\n" + b"".join(b"%d,\n" % k for k in range(250_000)), ".csv"
    nested = few + b"\n" * (900 * MIB)
    yield "csv_gz_in_gz", packed("gz", packed("gz", nested)), ".csv.gz"


def all_cases(draw, folder):
    for form, cases in ((".mcap", mcap_cases(draw)), (".bag", bag_cases(draw)), (".db3", db3_cases(draw, folder)),
                        (".h5", h5_cases(draw, folder)), (".mat", mat_cases(draw)), (".npz", npz_cases(draw, folder)),
                        ("", text_cases(draw))):
        for name, data, *ending in cases:
            yield name + (ending[0] if ending else form), data


def main(folder, seed):
    os.makedirs(folder, exist_ok=True)
    only = os.environ.get("ONLY", "")
    for name, data in all_cases(random.Random(int(seed)), folder):
        if only and only not in name:
            continue
        with open(os.path.join(folder, name), "wb") as file:
            file.write(data)
        print(f"{len(data):9} {name}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:3])
