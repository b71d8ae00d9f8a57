// SPDX-License-Identifier: MIT
#include "formats/messages/encode_joint_state.hpp"

#include "formats/bytes/little_endian.hpp"

namespace faultline {
namespace {

constexpr std::string_view kLittleEndian{"\0\1\0\0", 4};
constexpr std::size_t kStamp = 8;
constexpr std::int64_t kStateSecond = 1'000'000'000;

/// Pads to a multiple of `to`, counted from byte `begin`.
void align(std::string& out, std::size_t begin, std::size_t to) {
  out.append((to - (out.size() - begin) % to) % to, '\0');
}

void append_text(std::string& out, const std::string& text) {
  put_number(out, static_cast<std::uint32_t>(text.size() + 1));
  out.append(text);
  out.push_back('\0');
}

void append_numbers(std::string& out, std::size_t begin, const std::vector<double>& values) {
  align(out, begin, sizeof(std::uint32_t));
  put_number(out, static_cast<std::uint32_t>(values.size()));
  if (values.empty()) return;
  align(out, begin, sizeof(double));
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

}  // namespace

JointStateEncoder::JointStateEncoder(const std::vector<std::string>& names) {
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

void JointStateEncoder::append(std::int64_t stamp_ns, const JointRow& row, std::string& out) const {
  out.append(kLittleEndian);
  const std::size_t begin = out.size();
  put_number(out, static_cast<std::uint32_t>(stamp_ns / kStateSecond));
  put_number(out, static_cast<std::uint32_t>(stamp_ns % kStateSecond));
  out.append(names_);
  for (const std::vector<double>& values : row) append_numbers(out, begin, values);
}

}  // namespace faultline
