// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "formats/hdf5/hdf5_dataset.hpp"

namespace faultline {
namespace {

constexpr double kStorageMostExpansion = 1100.0;  ///< upper limit of the compression ratio of a filter
constexpr double kLeastChunk = 1 << 20;           ///< bytes that a chunk may take in any file
constexpr hsize_t kMostListed = 4096;             ///< chunks that are queried one by one
constexpr hsize_t kMostPlaces = hsize_t{1} << 40;

/// True for filters that are robust against damaged input.
bool is_safe(H5Z_filter_t filter) {
  return filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_FLETCHER32;
}

/// True when all filters that the dataset was written with are available.
bool has_filters(hid_t creation) {
  const int count = H5Pget_nfilters(creation);
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0, settings = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, &settings);
    if (!is_safe(filter) || H5Zfilter_avail(filter) <= 0) return false;
  }
  return count >= 0;
}

/// Returns the end of the written chunks along each kept dimension, if some are missing.
std::vector<std::int64_t> written_part(hid_t dataset, hid_t space, const Hdf5Shape& shape,
                                       const std::vector<std::int64_t>& chunk, hsize_t written) {
  const auto part = [&](std::size_t i, hsize_t end) {
    return std::min(shape.shape[i], static_cast<std::int64_t>(std::min(end, kMostPlaces)));
  };
  std::vector<std::int64_t> held(shape.shape.size(), 0);
  for (std::size_t i = 0; i < held.size() && written > kMostListed; ++i)
    held[i] = part(
        i, std::min(written, kMostPlaces / static_cast<hsize_t>(chunk[i])) * static_cast<hsize_t>(chunk[i]));
  for (hsize_t index = 0; index < written && written <= kMostListed; ++index) {
    std::vector<hsize_t> at(shape.dimensions.size());
    unsigned mask = 0;
    haddr_t address = 0;
    hsize_t size = 0;
    if (H5Dget_chunk_info(dataset, space, index, at.data(), &mask, &address, &size) < 0) continue;
    for (std::size_t i = 0; i < held.size(); ++i)
      held[i] = std::max(held[i],
                         part(i, std::min(at[shape.kept[i]], kMostPlaces) + static_cast<hsize_t>(chunk[i])));
  }
  return held;
}

std::optional<Hdf5Storage> chunk_storage(hid_t dataset, hid_t creation, const Hdf5Shape& shape,
                                         double file_bytes, std::string& why) {
  Hdf5Storage storage;
  std::vector<hsize_t> chunk(shape.dimensions.size());
  hsize_t written = 0;
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
  if (H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) < 0 ||
      H5Dget_num_chunks(dataset, space, &written) < 0) {
    why = "the index of its chunks is damaged";
    return std::nullopt;
  }
  double bytes = static_cast<double>(H5Tget_size(type)), chunks = 1.0;
  for (const hsize_t size : chunk) bytes *= static_cast<double>(size);
  if (bytes > kStorageMostExpansion * file_bytes + kLeastChunk) {
    why = "its chunks are larger than the file could hold";
    return std::nullopt;
  }
  storage.chunk_bytes = static_cast<std::int64_t>(bytes);
  for (std::size_t i = 0; i < shape.kept.size(); ++i) {
    storage.chunk.push_back(static_cast<std::int64_t>(std::max<hsize_t>(1, chunk[shape.kept[i]])));
    chunks *= std::ceil(static_cast<double>(shape.shape[i]) / static_cast<double>(storage.chunk[i]));
  }
  storage.has_holes = static_cast<double>(written) < chunks;
  storage.unwritten = written == 0;
  storage.held =
      storage.has_holes ? written_part(dataset, space, shape, storage.chunk, written) : shape.shape;
  return storage;
}

std::int64_t elements_of(const Hdf5Shape& shape) {
  std::int64_t all = 1;
  for (const std::int64_t size : shape.shape) all *= size;
  return all;
}

}  // namespace

std::optional<Hdf5Storage> hdf5_storage(hid_t dataset, const Hdf5Shape& shape, std::int64_t file_bytes,
                                        std::string& why) {
  const Hdf5Id creation(H5Dget_create_plist(dataset), H5Pclose), type(H5Dget_type(dataset), H5Tclose);
  if (H5Pget_external_count(creation) > 0) {
    why = "its numbers are in another file, which is not read";
    return std::nullopt;
  }
  if (!has_filters(creation)) {
    why = "its compression is not gzip, the only one that can be read; write it again with gzip";
    return std::nullopt;
  }
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_CHUNKED)
    return chunk_storage(dataset, creation, shape, static_cast<double>(file_bytes), why);
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS) {
    why =
        "it has a layout that cannot be read, such as that of a virtual dataset; copy it into an ordinary "
        "dataset";
    return std::nullopt;
  }
  const haddr_t at = layout == H5D_COMPACT ? 0 : H5Dget_offset(dataset);
  const bool in_file = at != HADDR_UNDEF && at < static_cast<haddr_t>(file_bytes);
  const std::int64_t bytes = in_file ? file_bytes - static_cast<std::int64_t>(at) : 0;
  const auto item = static_cast<std::int64_t>(std::max<std::size_t>(1, H5Tget_size(type)));
  Hdf5Storage storage;
  storage.elements_held = std::min(elements_of(shape), bytes / item);
  storage.unwritten = at == HADDR_UNDEF;
  return storage;
}

}  // namespace faultline
