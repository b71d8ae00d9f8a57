// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

/// The functions of each format in the table of log_formats.cpp: recognising a file by its first bytes,
/// reading it, writing it. Reading throws Error(input) when nothing of the file can be read.
namespace faultline {

/// True for any text; false for binary bytes and UTF-16.
bool looks_like_csv(std::string_view head);
/// Opens a text table in any dialect; see docs/formats-csv.md. Throws Error(input) for a column named twice,
/// too many columns, or a line that is too long.
std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes);
/// Creates comma-separated text: header `t,q1..,dq1..,tau1..`, further channels after them, the shortest
/// digits that restore the same double, an empty cell for a missing value.
std::unique_ptr<LogWriter> create_csv(const std::string& path);

/// True for the header of a DIAdem recording, such as one of KUKA Trace.
bool looks_like_diadem(std::string_view head);
/// Opens a DIAdem header with the data files beside it, see docs/formats-kuka.md. Its hash is that of all
/// files.
std::unique_ptr<RawReader> open_diadem(std::unique_ptr<ByteSource> bytes);
/// Returns the paths of the data files that the header names and that exist. Throws Error(input) for a header
/// that cannot be read.
std::vector<std::string> files_beside_diadem(ByteSource& bytes);

/// True when the file is HDF5, also after a block that another program put before it.
bool looks_like_hdf5(std::string_view head);
/// Opens the datasets of an HDF5 file, see docs/formats-hdf5.md.
std::unique_ptr<RawReader> open_hdf5(std::unique_ptr<ByteSource> bytes);
/// Creates an HDF5 file with a dataset per quantity, see docs/formats-hdf5.md: chunks with checksums, written
/// when they are full.
std::unique_ptr<LogWriter> create_hdf5(const std::string& path);

bool looks_like_matlab(std::string_view head);
/// Opens a MATLAB file of version 5 to 7.3, see docs/formats-matlab.md.
std::unique_ptr<RawReader> open_matlab(std::unique_ptr<ByteSource> bytes);
/// Creates a MATLAB file of version 5 (as save -v6 does), see docs/formats-matlab.md. The whole log is kept
/// in memory until commit(), which throws Error(output) when an array is larger than such a file may hold.
std::unique_ptr<LogWriter> create_matlab(const std::string& path);

bool looks_like_mcap(std::string_view head);
/// Opens the joint states of an MCAP recording, read from front to back; its index is only checked.
std::unique_ptr<RawReader> open_mcap(std::unique_ptr<ByteSource> bytes);
/// Creates a recording of sensor_msgs/JointState messages of ROS 2, which Foxglove and PlotJuggler open.
/// Times are written in whole nanoseconds and cannot be before 0.
std::unique_ptr<LogWriter> create_mcap(const std::string& path);

/// True when one of the two copies of the header begins in `head`.
bool looks_like_native(std::string_view head);
/// Opens a native log. Damaged chunks are omitted and reported, a cut file is read to its last whole chunk.
/// Throws Error(input) when both copies of the header are damaged, or the file is of another version.
std::unique_ptr<RawReader> open_native(std::unique_ptr<ByteSource> bytes);
/// Creates the native binary format (.flog), see docs/formats-native.md: exact doubles, a checksum per chunk.
std::unique_ptr<LogWriter> create_native(const std::string& path);

bool looks_like_npy(std::string_view head);
bool looks_like_npz(std::string_view head);
/// Open an array file of numpy, see docs/formats-numpy.md.
std::unique_ptr<RawReader> open_npy(std::unique_ptr<ByteSource> bytes);
std::unique_ptr<RawReader> open_npz(std::unique_ptr<ByteSource> bytes);
/// Creates an .npz file for numpy.load(), see docs/formats-numpy.md. The log is in memory until commit().
std::unique_ptr<LogWriter> create_npz(const std::string& path);

bool looks_like_rosbag1(std::string_view head);
bool looks_like_rosbag2(std::string_view head);
/// Opens the joint states of a ROS 1 bag, version 2.0, read from front to back.
std::unique_ptr<RawReader> open_rosbag1(std::unique_ptr<ByteSource> bytes);
/// Opens the joint states of a rosbag2 recording in SQLite by number; Error(input) for a compressed file.
std::unique_ptr<RawReader> open_rosbag2(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
