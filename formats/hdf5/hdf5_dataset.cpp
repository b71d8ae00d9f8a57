// SPDX-License-Identifier: MIT
#include "formats/hdf5/hdf5_dataset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr double kStorageMostExpansion = 1100.0;  ///< upper limit of the compression ratio of a filter
constexpr double kLeastChunk = 1 << 20;           ///< bytes that a chunk may take in any file
constexpr hsize_t kMostListed = 4096;             ///< chunks that are queried one by one
constexpr hsize_t kMostPlaces = hsize_t{1} << 40;

std::int64_t elements_of(const std::vector<std::int64_t>& shape) {
  std::int64_t all = 1;
  for (const std::int64_t size : shape) all *= size;
  return all;
}

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

constexpr std::int64_t kMostNumbers = 1 << 14;  ///< of a record
constexpr std::int64_t kMostElements = std::int64_t{1} << 53;
constexpr std::int64_t kBlockNumbers = 1 << 20;  ///< read at once

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

}  // namespace

std::optional<Hdf5Dataset> Hdf5Dataset::open(hid_t file, const std::string& path, std::int64_t file_bytes,
                                             std::string& why) {
  Hdf5Dataset opened;
  opened.dataset_ = {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (!opened.dataset_.ok()) {
    why = "it is damaged";
    return std::nullopt;
  }
  const Hdf5Id type(H5Dget_type(opened.dataset_), H5Tclose);
  if (!type.ok() || !opened.find_fields(type) || !opened.find_shape()) return std::nullopt;
  if (opened.shape_.size() > 2) return opened;  // only its shape is reported
  why = opened.find_storage(file_bytes);
  if (!why.empty()) return std::nullopt;
  opened.path_ = path;
  return opened;
}

std::vector<std::int64_t> Hdf5Dataset::shape() const {
  if (!turned_) return shape_;
  return {shape_.rbegin(), shape_.rend()};
}

/// Finds how the elements are stored; returns the reason when they cannot be read, else an empty text.
const char* Hdf5Dataset::find_storage(std::int64_t file_bytes) {
  const Hdf5Id creation(H5Dget_create_plist(dataset_), H5Pclose), type(H5Dget_type(dataset_), H5Tclose);
  if (H5Pget_external_count(creation) > 0) return "its numbers are in another file, which is not read";
  if (!has_filters(creation))
    return "its compression is not gzip, the only one that this reader knows; write it again with gzip";
  const auto item = static_cast<std::int64_t>(H5Tget_size(type));
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_CHUNKED)
    return find_chunks(creation, static_cast<double>(item), static_cast<double>(file_bytes));
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS)
    return "it has a layout that cannot be read, such as that of a virtual dataset; copy it into an ordinary "
           "dataset";
  const haddr_t at = layout == H5D_COMPACT ? 0 : H5Dget_offset(dataset_);
  const bool in_file = at != HADDR_UNDEF && at < static_cast<haddr_t>(file_bytes);
  const std::int64_t bytes = in_file ? file_bytes - static_cast<std::int64_t>(at) : 0;
  storage_.elements_held = std::min(elements_of(shape_), bytes / std::max<std::int64_t>(1, item));
  storage_.unwritten = at == HADDR_UNDEF;
  return "";
}

/// Does the same for a dataset in chunks, whose elements take `item_bytes` each.
const char* Hdf5Dataset::find_chunks(hid_t creation, double item_bytes, double file_bytes) {
  std::vector<hsize_t> chunk(dimensions_.size());
  hsize_t written = 0;
  const Hdf5Id space(H5Dget_space(dataset_), H5Sclose);
  if (H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data()) < 0 ||
      H5Dget_num_chunks(dataset_, space, &written) < 0)
    return "the index of its chunks is damaged";
  double bytes = item_bytes, chunks = 1.0;
  for (const hsize_t size : chunk) bytes *= static_cast<double>(size);
  if (bytes > kStorageMostExpansion * file_bytes + kLeastChunk)
    return "its chunks are larger than the file could hold";
  storage_.chunk_bytes = static_cast<std::int64_t>(bytes);
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    storage_.chunk.push_back(static_cast<std::int64_t>(std::max<hsize_t>(1, chunk[kept_[i]])));
    chunks *= std::ceil(static_cast<double>(shape_[i]) / static_cast<double>(storage_.chunk[i]));
  }
  storage_.has_holes = static_cast<double>(written) < chunks;
  storage_.unwritten = written == 0;
  storage_.held = storage_.has_holes ? written_part(space, written) : shape_;
  return "";
}

/// Returns the end of the written chunks along each kept dimension, if some are missing.
std::vector<std::int64_t> Hdf5Dataset::written_part(hid_t space, hsize_t written) const {
  const auto part = [&](std::size_t i, hsize_t end) {
    return std::min(shape_[i], static_cast<std::int64_t>(std::min(end, kMostPlaces)));
  };
  const auto chunk = [&](std::size_t i) { return static_cast<hsize_t>(storage_.chunk[i]); };
  std::vector<std::int64_t> held(shape_.size(), 0);
  for (std::size_t i = 0; i < held.size() && written > kMostListed; ++i)
    held[i] = part(i, std::min(written, kMostPlaces / chunk(i)) * chunk(i));
  for (hsize_t index = 0; index < written && written <= kMostListed; ++index) {
    std::vector<hsize_t> at(dimensions_.size());
    unsigned mask = 0;
    haddr_t address = 0;
    hsize_t size = 0;
    if (H5Dget_chunk_info(dataset_, space, index, at.data(), &mask, &address, &size) < 0) continue;
    for (std::size_t i = 0; i < held.size(); ++i)
      held[i] = std::max(held[i], part(i, std::min(at[kept_[i]], kMostPlaces) + chunk(i)));
  }
  return held;
}

bool Hdf5Dataset::find_shape() {
  const Hdf5Id space(H5Dget_space(dataset_), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (!space.ok() || rank < 1) return false;
  dimensions_.resize(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, dimensions_.data(), nullptr);
  std::int64_t all = 1;
  for (std::size_t i = 0; i < dimensions_.size(); ++i) {
    const hsize_t size = dimensions_[i];
    if (size > static_cast<hsize_t>(kMostElements / all)) return false;
    all *= std::max<std::int64_t>(1, static_cast<std::int64_t>(size));
    if (size == 1 && dimensions_.size() > 2) continue;
    kept_.push_back(i);
    shape_.push_back(static_cast<std::int64_t>(size));
  }
  if (shape_.empty()) return false;
  return shape_.size() == 1 || fields_[0].name.empty();
}

/// Adds a member of a record of numbers, unless it holds anything else; false when the library fails.
bool Hdf5Dataset::add_member(hid_t type, unsigned index) {
  const Hdf5Id member(H5Tget_member_type(type, index), H5Tclose);
  Hdf5Id number(H5Tcopy(member), H5Tclose), read_as(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose);
  std::int64_t width = 1;
  const bool is_array = H5Tget_class(member) == H5T_ARRAY;
  const int rank = is_array ? H5Tget_array_ndims(member) : 0;
  hsize_t size[H5S_MAX_RANK] = {};
  if (is_array && (rank < 1 || H5Tget_array_dims2(member, size) < 0)) return true;
  for (int i = 0; i < rank; ++i) width *= static_cast<std::int64_t>(std::min<hsize_t>(size[i], kMostNumbers));
  if (is_array) number = {H5Tget_super(member), H5Tclose};
  char* const name = H5Tget_member_name(type, index);
  bool good = true;
  if (name && is_number(number) && static_cast<std::int64_t>(numbers_) + width <= kMostNumbers) {
    if (is_array)
      read_as = {H5Tarray_create2(H5T_NATIVE_DOUBLE, static_cast<unsigned>(rank), size), H5Tclose};
    good = H5Tinsert(memory_type_, name, numbers_ * sizeof(double), read_as) >= 0;
    fields_.push_back({name, numbers_, width});
    numbers_ += static_cast<std::size_t>(width);
  }
  H5free_memory(name);
  return good;
}

/// Finds the fields, and the memory type by which elements are read: all numbers as doubles.
bool Hdf5Dataset::find_fields(hid_t type) {
  if (is_number(type)) {
    fields_.push_back({});
    memory_type_ = {H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose};
    return true;
  }
  if (H5Tget_class(type) != H5T_COMPOUND) return false;
  numbers_ = 0;
  memory_type_ = {H5Tcreate(H5T_COMPOUND, kMostNumbers * sizeof(double)), H5Tclose};
  const int members = H5Tget_nmembers(type);
  for (int i = 0; i < members; ++i)
    if (!add_member(type, static_cast<unsigned>(i))) return false;
  return numbers_ > 0 && H5Tset_size(memory_type_, numbers_ * sizeof(double)) >= 0;
}

std::int64_t Hdf5Dataset::row_chunk_bytes(bool channel_major) const {
  if (storage_.chunk.empty()) return 0;
  if (shape_.size() < 2) return storage_.chunk_bytes;
  const std::size_t other = 1 - axis(channel_major);
  return storage_.chunk_bytes * ((shape_[other] + storage_.chunk[other] - 1) / storage_.chunk[other]);
}

void Hdf5Dataset::set_chunk_cache(hid_t file, std::int64_t bytes) {
  const Hdf5Id access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, static_cast<std::size_t>(bytes), 1.0);
  Hdf5Id again(H5Dopen2(file, path_.c_str(), access), H5Dclose);
  if (again.ok()) dataset_ = std::move(again);
}

std::int64_t Hdf5Dataset::rows_held(bool channel_major) const {
  const std::size_t along = axis(channel_major);
  if (!storage_.chunk.empty()) return storage_.held[along];
  if (shape_.size() < 2 || along == 1 || elements_of(shape_) == 0)
    return std::min(shape_[along], storage_.elements_held);
  return storage_.elements_held / shape_[1];
}

std::int64_t Hdf5Dataset::columns_held(bool channel_major) const {
  if (shape_.size() < 2) return fields_[0].name.empty() ? 1 : std::numeric_limits<std::int64_t>::max();
  const std::size_t along = axis(channel_major);
  if (!storage_.chunk.empty() || along == 0 || elements_of(shape_) == 0) return shape_[1 - along];
  return std::max<std::int64_t>(storage_.elements_held / shape_[1], storage_.elements_held > 0 ? 1 : 0);
}

/// True when all chunks in the row of chunks that begins with row `first` were written.
bool Hdf5Dataset::is_written(bool channel_major, std::int64_t first) const {
  if (!storage_.has_holes) return true;
  std::vector<hsize_t> at(dimensions_.size(), 0);
  const std::size_t row = axis(channel_major), other = 1 - row;
  const bool matrix = shape_.size() > 1;
  at[kept_[row]] = static_cast<hsize_t>(first);
  const std::int64_t columns = matrix ? shape_[other] : 1, step = matrix ? storage_.chunk[other] : 1;
  for (std::int64_t column = 0; column < columns; column += step) {
    if (matrix) at[kept_[other]] = static_cast<hsize_t>(column);
    unsigned mask = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t size = 0;
    const herr_t found = H5Dget_chunk_info_by_coord(dataset_, at.data(), &mask, &address, &size);
    if (found < 0 || address == HADDR_UNDEF || size == 0) return false;
  }
  return true;
}

namespace {

/// A transfer of so many elements. For one of records the library takes and clears a buffer of 1 MiB, however
/// few there are; this one is no larger than the elements.
Hdf5Id transfer_of(hid_t dataset, hid_t memory_type, std::int64_t elements) {
  Hdf5Id transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose);
  const std::size_t element = std::max(H5Tget_size(type), H5Tget_size(memory_type));
  const std::size_t usual = H5Pget_buffer(transfer, nullptr, nullptr);
  if (element > 0 && static_cast<std::size_t>(elements) < usual / element)
    H5Pset_buffer(transfer, static_cast<std::size_t>(elements) * element, nullptr, nullptr);
  return transfer;
}

}  // namespace

bool Hdf5Dataset::read_block(bool channel_major, std::int64_t first, std::int64_t rows, std::int64_t column,
                             std::int64_t columns, double* to) {
  std::vector<hsize_t> start(dimensions_.size(), 0), count(dimensions_.size(), 1);
  start[kept_[axis(channel_major)]] = static_cast<hsize_t>(first);
  count[kept_[axis(channel_major)]] = static_cast<hsize_t>(rows);
  if (shape_.size() > 1) {
    const std::size_t other = kept_[1 - axis(channel_major)];
    start[other] = static_cast<hsize_t>(column);
    count[other] = static_cast<hsize_t>(columns);
  }
  const Hdf5Id transfer = transfer_of(dataset_, memory_type_, shape_.size() > 1 ? rows * columns : rows);
  // A memory space of the same shape lets the library copy whole chunks.
  const Hdf5Id space(H5Dget_space(dataset_), H5Sclose),
      memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  return H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
         H5Dread(dataset_, memory_type_, memory, space, transfer, to) >= 0;
}

/// Reads rows, all in one row of chunks if some chunks are missing; true on success.
bool Hdf5Dataset::read_rows(const Hdf5Field& field, const ArrayBand& band, std::int64_t first,
                            std::int64_t rows, BandValues& values) {
  const bool matrix = shape_.size() > 1, by_columns = axis(band.channel_major) == 1;
  const std::int64_t low = matrix ? band.columns.front() : 0;
  const std::int64_t columns = matrix ? band.columns.back() - low + 1 : static_cast<std::int64_t>(numbers_);
  const bool known = !field.name.empty() && block_first_ == first && block_rows_ == rows;
  if (!known) {
    block_first_ = -1;
    block_.resize(static_cast<std::size_t>(rows * columns));
    if (!is_written(band.channel_major, first) ||
        !read_block(band.channel_major, first, rows, low, columns, block_.data()))
      return false;
    block_first_ = first;
    block_rows_ = rows;
  }
  const auto all = static_cast<std::size_t>(rows), step = by_columns ? 1 : static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < band.columns.size(); ++i) {
    const auto c = static_cast<std::size_t>(band.columns[i] - low);
    double* to = values.columns[i].data() + (first - band.first_row);
    const double* from = block_.data() + (by_columns ? c * all : field.at + c);
    for (std::size_t row = 0; row < all; ++row) to[row] = from[row * step];
  }
  return true;
}

/// Reads one row of chunks after the other; adds those that cannot be read to values.lost.
void Hdf5Dataset::read_by_chunks(const Hdf5Field& field, const ArrayBand& band, std::int64_t first,
                                 std::int64_t rows, BandValues& values) {
  const bool chunked = !storage_.chunk.empty();
  const std::int64_t chunk = chunked ? storage_.chunk[axis(band.channel_major)] : rows;
  for (std::int64_t done = 0; done < rows;) {
    const std::int64_t in_chunk = chunked ? chunk - (first + done) % chunk : rows;
    const std::int64_t now = std::min(in_chunk, rows - done);
    if (!read_rows(field, band, first + done, now, values))
      values.lost.push_back({first + done - band.first_row, now});
    done += now;
  }
}

void Hdf5Dataset::read(const Hdf5Field& field, const ArrayBand& band, BandValues& values) {
  const std::int64_t width = shape_.size() > 1 ? band.columns.back() - band.columns.front() + 1
                                               : static_cast<std::int64_t>(numbers_);
  const std::int64_t at_once = std::max<std::int64_t>(1, kBlockNumbers / std::max<std::int64_t>(1, width));
  for (std::int64_t done = 0; done < band.rows; done += at_once) {
    const std::int64_t first = band.first_row + done, rows = std::min(at_once, band.rows - done);
    if (storage_.has_holes || !read_rows(field, band, first, rows, values))
      read_by_chunks(field, band, first, rows, values);
  }
}

}  // namespace faultline
