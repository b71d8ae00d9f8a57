// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace faultline {

/// Kinds of records of a ROS 1 bag, version 2.0 (wiki.ros.org/Bags/Format/2.0).
enum class Rosbag1Op : unsigned char {
  message = 0x02,
  bag_header = 0x03,
  index = 0x04,
  chunk = 0x05,
  chunk_info = 0x06,
  connection = 0x07,
};

inline constexpr std::string_view kRosbag1Magic = "#ROSBAG V2.0\n";

/// The fields of a header of name=value pairs, each after its length. Missing fields are empty.
class Rosbag1Fields {
 public:
  explicit Rosbag1Fields(std::string_view header) : header_(header) {}
  std::string_view text(std::string_view name) const;
  /// Returns a little-endian number; 0 when it is missing or of another size.
  std::uint32_t word(std::string_view name) const;
  /// Converts a time in seconds and nanoseconds to ns.
  std::int64_t time(std::string_view name) const;
  /// True when it has an operation code; the code.
  bool has_op() const { return text("op").size() == 1; }
  Rosbag1Op op() const { return static_cast<Rosbag1Op>(text("op")[0]); }

 private:
  std::string_view header_;
};

/// A record at the front of `bytes`: a header and its data, each after its length.
struct Rosbag1Record {
  Rosbag1Fields fields{""};
  std::string_view data;
  std::size_t size = 0;  ///< of the whole record; 0 when it is incomplete
};
Rosbag1Record rosbag1_record(std::string_view bytes);

/// Returns the bytes of the record at the front of `bytes`, which need not be all in view; 0 when the length
/// of its data is not in view.
std::uint64_t rosbag1_record_size(std::string_view bytes);

/// Returns the position of a record of at most `left` bytes whose header has the operation at `at`; npos for
/// none.
std::size_t rosbag1_record_before(std::string_view bytes, std::size_t at, std::uint64_t left);

}  // namespace faultline
