// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/little_endian.hpp"

namespace faultline {

/// Positions, velocities and efforts of joints in one row; an array that the log lacks is empty.
using JointRow = std::array<std::vector<double>, 3>;

/// Writes sensor_msgs/JointState messages of ROS 2 as little-endian CDR.
class JointStateEncoder {
 public:
  explicit JointStateEncoder(const std::vector<std::string>& names) {
    std::string out(kStamp, '\0');  // the bytes before determine the padding
    append_text(out, "");
    align(out, 0, sizeof(std::uint32_t));
    put_number(out, static_cast<std::uint32_t>(names.size()));
    for (const std::string& name : names) {
      align(out, 0, sizeof(std::uint32_t));
      append_text(out, name);
    }
    names_ = out.substr(kStamp);
  }

  /// Appends a message.
  void append(std::int64_t stamp_ns, const JointRow& row, std::string& out) const {
    out.append(kLittleEndian);
    const std::size_t begin = out.size();
    put_number(out, static_cast<std::uint32_t>(stamp_ns / kSecond_ns));
    put_number(out, static_cast<std::uint32_t>(stamp_ns % kSecond_ns));
    out.append(names_);
    for (const std::vector<double>& values : row) append_numbers(out, begin, values);
  }

  /// Type and definition, as a recording declares it.
  static constexpr const char* kType = "sensor_msgs/msg/JointState";
  static constexpr const char* kDefinition =
      "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n"
      "================================================================================\n"
      "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
      "================================================================================\n"
      "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";

 private:
  static constexpr std::string_view kLittleEndian{"\0\1\0\0", 4};
  static constexpr std::size_t kStamp = 8;  ///< bytes
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;

  /// Pads to a multiple of `to`, counted from byte `begin`.
  static void align(std::string& out, std::size_t begin, std::size_t to) {
    out.append((to - (out.size() - begin) % to) % to, '\0');
  }

  static void append_text(std::string& out, const std::string& text) {
    put_number(out, static_cast<std::uint32_t>(text.size() + 1));
    out.append(text);
    out.push_back('\0');
  }

  static void append_numbers(std::string& out, std::size_t begin, const std::vector<double>& values) {
    align(out, begin, sizeof(std::uint32_t));
    put_number(out, static_cast<std::uint32_t>(values.size()));
    if (values.empty()) return;
    align(out, begin, sizeof(double));
    out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }

  std::string names_;  ///< encoded, after the frame
};

}  // namespace faultline
