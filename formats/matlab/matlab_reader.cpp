// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include "formats/arrays/array_reader.hpp"
#include "formats/hdf5/hdf5_format.hpp"
#include "formats/matlab/mat5_file.hpp"
#include "formats/matlab/matlab_format.hpp"

namespace faultline {
namespace {

constexpr std::string_view kFirstWords = "MATLAB 5.0 MAT-file", kFirstWords73 = "MATLAB 7.3 MAT-file";
constexpr std::size_t kVersionAt = 124;

/// Converts a path in HDF5 to the name that MATLAB shows.
std::string name_of_path(const std::string& path) {
  std::string name = path;
  std::replace(name.begin(), name.end(), '/', '.');
  return matlab_name(name);
}

std::unique_ptr<ArrayFile> open_mat73_arrays(const std::string& path) {
  return open_hdf5_arrays(path, name_of_path);
}

}  // namespace

bool looks_like_matlab(std::string_view head) {
  const std::string_view version = head.substr(std::min(kVersionAt, head.size()), 4);
  const std::string_view little("\0\x01IM", 4), big("\x01\0MI", 4);
  return version == little || version == big || head.starts_with(kFirstWords) ||
         head.starts_with(kFirstWords73);
}

std::unique_ptr<RawReader> open_matlab(std::unique_ptr<ByteSource> bytes) {
  const bool hdf5 = looks_like_hdf5(bytes->head()) || bytes->head().starts_with(kFirstWords73);
  return read_arrays(std::move(bytes), "matlab", hdf5 ? open_mat73_arrays : open_mat5_arrays);
}

}  // namespace faultline
