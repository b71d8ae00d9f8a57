// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

/// .npy files byte by byte.
namespace faultline {

/// The elements one after another, in either byte order.
template <typename Element>
std::string elements(const std::vector<Element>& values, bool big_endian = false) {
  std::string bytes;
  for (const Element value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return bytes;
}

/// `descr` is a Python literal, such as "'<f8'".
inline std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                       bool fortran_order = false, char version = 1) {
  std::string text = "{'descr': " + descr + ", 'fortran_order': " + (fortran_order ? "True" : "False") +
                     ", 'shape': " + shape + ", }\n";
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  const auto size = static_cast<std::uint32_t>(text.size());
  bytes.append(reinterpret_cast<const char*>(&size), version == 1 ? 2 : 4);
  return bytes + text + data;
}

}  // namespace faultline
