// SPDX-License-Identifier: MIT
#include "formats/hdf5/hdf5_text.hpp"

#include <cstring>

namespace faultline {
namespace {

constexpr hssize_t kMostTexts = 1 << 14;
constexpr std::size_t kMostBytes = 1 << 24;

/// Reads texts by `read`, which takes a memory type and where to put them.
template <typename Read>
std::vector<std::string> texts_of(hid_t type, hid_t space, Read read) {
  std::vector<std::string> texts;
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || count <= 0 || count > kMostTexts || size == 0 || size > kMostBytes)
    return texts;
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
    if (read(pointers.data()) >= 0)
      for (const char* text : pointers) texts.emplace_back(text ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return texts;
  }
  if (size > kMostBytes / static_cast<std::size_t>(count)) return texts;
  std::string bytes(size * static_cast<std::size_t>(count), '\0');
  if (read(bytes.data()) < 0) return texts;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    std::string text = bytes.substr(at, size);
    text.resize(std::strlen(text.c_str()));
    while (H5Tget_strpad(type) == H5T_STR_SPACEPAD && !text.empty() && text.back() == ' ') text.pop_back();
    texts.push_back(text);
  }
  return texts;
}

}  // namespace

std::vector<std::string> hdf5_attribute(hid_t object, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (H5Aexists(object, name.c_str()) <= 0) continue;
    const Hdf5Id attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!attribute.ok()) continue;
    const Hdf5Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
    const auto texts = texts_of(type, space, [&](void* to) { return H5Aread(attribute, type, to); });
    if (!texts.empty()) return texts;
  }
  return {};
}

std::vector<std::string> hdf5_texts(hid_t dataset) {
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  return texts_of(type, space,
                  [&](void* to) { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); });
}

}  // namespace faultline
