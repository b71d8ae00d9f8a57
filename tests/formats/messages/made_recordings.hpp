// SPDX-License-Identifier: MIT
#pragma once

#include <bzlib.h>
#include <zstd.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bytes/little_endian.hpp"
#include "formats/mcap/mcap_record.hpp"
#include "formats/messages/encode_joint_state.hpp"
#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

// Recordings as bytes, by the specifications of their formats, with what no recorder would write.
namespace faultline::made {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A sensor_msgs/JointState of ROS 2, stamped 10 s and `k` ms.
inline std::string joint_state(int k, const std::vector<std::string>& names,
                               const std::vector<double>& position) {
  std::string out;
  JointStateEncoder(names).append(10 * kSecond_ns + k * kPeriod_ns, {position, position, {}}, out);
  return out;
}

inline std::string zstd_packed(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

inline std::string bz2_packed(std::string bytes) {
  std::string out(bytes.size() + bytes.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  BZ2_bzBuffToBuffCompress(out.data(), &size, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0, 0);
  out.resize(size);
  return out;
}

// ---- MCAP

inline std::string record(McapOp op, std::string_view content) {
  ByteBuilder out;
  out.put(static_cast<unsigned char>(op)).put(static_cast<std::uint64_t>(content.size())).put_bytes(content);
  return out.bytes();
}

inline std::string topic(std::uint16_t id, const std::string& name,
                         const std::string& type = "sensor_msgs/msg/JointState") {
  ByteBuilder schema, channel;
  schema.put(id).put_text(type).put_text("ros2msg").put_text("");
  channel.put(id).put(id).put_text(name).put_text("cdr").put_text("");
  return record(McapOp::schema, schema.bytes()) + record(McapOp::channel, channel.bytes());
}

inline std::string message(std::uint16_t channel, int k, std::string_view bytes) {
  ByteBuilder out;
  const auto time = static_cast<std::uint64_t>(10 * kSecond_ns + k * kPeriod_ns);
  out.put(channel).put(std::uint32_t{0}).put(time).put(time).put_bytes(bytes);
  return record(McapOp::message, out.bytes());
}

/// Messages of one channel about the same joints, from `first` on.
inline std::string states(std::uint16_t channel, int first, int count, const std::vector<std::string>& names,
                          double at = 0.0) {
  std::string out;
  for (int k = first; k < first + count; ++k)
    out += message(channel, k, joint_state(k, names, std::vector<double>(names.size(), at + 1e-3 * k)));
  return out;
}

inline std::string chunk(const std::string& inside) {
  const std::string packed = zstd_packed(inside);
  ByteBuilder out;
  out.put(std::uint64_t{0}).put(~std::uint64_t{0}).put(static_cast<std::uint64_t>(inside.size()));
  out.put(std::uint32_t{0}).put_text("zstd").put(static_cast<std::uint64_t>(packed.size())).put_bytes(packed);
  return record(McapOp::chunk, out.bytes());
}

inline std::string mcap(const std::string& records) {
  ByteBuilder header;
  header.put_text("").put_text("");
  return std::string(kMcapMagic) + record(McapOp::header, header.bytes()) + records +
         record(McapOp::data_end, std::string(4, '\0')) + record(McapOp::footer, std::string(20, '\0')) +
         std::string(kMcapMagic);
}

// ---- ROS 1 bag

using Fields = std::vector<std::pair<std::string, std::string>>;

inline std::string bag_fields(const Fields& fields) {
  ByteBuilder out;
  for (const auto& [name, value] : fields) out.put_text(name + "=" + value);
  return out.bytes();
}

inline std::string word(std::uint32_t value) {
  ByteBuilder out;
  return out.put(value).bytes();
}

inline std::string bag_record(const Fields& fields, std::string_view data) {
  ByteBuilder out;
  out.put_text(bag_fields(fields)).put_text(std::string(data));
  return out.bytes();
}

inline std::string connection(std::uint32_t id, const std::string& name,
                              const std::string& type = "sensor_msgs/JointState") {
  return bag_record({{"conn", word(id)}, {"topic", name}, {"op", "\x07"}},
                    bag_fields({{"topic", name}, {"type", type}}));
}

/// A JointState of ROS 1 about joints at `at`.
inline std::string bag_state(std::uint32_t id, int k, const std::vector<std::string>& names, double at) {
  ByteBuilder out;
  const auto nanoseconds = static_cast<std::uint32_t>(k * kPeriod_ns);
  out.put(static_cast<std::uint32_t>(k)).put(std::uint32_t{10}).put(nanoseconds).put_text("");
  out.put(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) out.put_text(name);
  for (int array = 0; array < 2; ++array) {
    out.put(static_cast<std::uint32_t>(names.size()));
    for (std::size_t j = 0; j < names.size(); ++j) out.put(std::bit_cast<std::uint64_t>(at + 1e-3 * k));
  }
  out.put(std::uint32_t{0});
  return bag_record({{"conn", word(id)}, {"op", "\x02"}, {"time", word(10) + word(nanoseconds)}},
                    out.bytes());
}

inline std::string bag_chunk(const std::string& inside) {
  return bag_record(
      {{"op", "\x05"}, {"compression", "bz2"}, {"size", word(static_cast<std::uint32_t>(inside.size()))}},
      bz2_packed(inside));
}

inline std::string bag(const std::string& records) {
  return "#ROSBAG V2.0\n" + bag_record({{"op", "\x03"}}, std::string(4000, ' ')) + records;
}

// ---- what is read of them

struct Reading {
  Log log;
  std::int64_t rows_read = 0;
  Issues issues;
  std::string refused;  ///< why nothing was read

  std::string message_of(const std::string& code) const {
    for (const Issue& issue : issues.all())
      if (issue.code == code) return issue.message;
    return "";
  }
};

inline Reading read_file(const std::string& path, const OpenLogOptions& options = {}) {
  Reading reading;
  try {
    const auto source = open_log(path, options);
    reading.log = read_all(*source);
    reading.rows_read = source->identity().rows_read;
    reading.issues = source->issues();
  } catch (const Error& error) {
    reading.refused = error.what();
  }
  return reading;
}

inline Reading read(const std::string& bytes, const OpenLogOptions& options = {}) {
  const TemporaryFolder folder;
  return read_file(folder.write("recording", bytes), options);
}

}  // namespace faultline::made
