// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "formats/hdf5/hdf5_library.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Storage of the elements of a dataset. Vectors are along the kept dimensions.
struct Hdf5Storage {
  std::vector<std::int64_t> chunk;  ///< empty when it is in one piece
  std::int64_t chunk_bytes = 0;
  std::vector<std::int64_t> held;  ///< of chunked ones, up to the last chunks written
  bool unwritten = false;          ///< there is room for elements, but none was written
  bool has_holes = false;          ///< some chunks were never written
  std::int64_t elements_held = 0;  ///< of others: number from the front that the file can hold
};

/// Numbers of one element of a dataset. A plain number is its own only field.
struct Hdf5Field {
  std::string name;        ///< empty for a plain number
  std::size_t at = 0;      ///< index of its first number in the element
  std::int64_t width = 1;  ///< count of numbers, more than one for an array in a record
  std::string unit{};
  std::vector<std::string> names{}, units{};
};

/// A dataset of numbers, or of records of numbers, that is read by blocks of rows.
class Hdf5Dataset {
 public:
  /// Opens a dataset; nullopt when it holds no numbers. `why` gives the reason if it could hold some.
  static std::optional<Hdf5Dataset> open(hid_t file, const std::string& path, std::int64_t file_bytes,
                                         std::string& why);

  /// The shape without surplus dimensions of one, turned if turn() was called.
  std::vector<std::int64_t> shape() const;
  /// Exchanges the dimensions of a matrix in shape() and in all bands.
  void turn() { turned_ = true; }
  const std::vector<Hdf5Field>& fields() const { return fields_; }
  std::vector<Hdf5Field>& fields() { return fields_; }
  std::int64_t rows_held(bool channel_major) const;
  bool unwritten() const { return storage_.unwritten; }
  std::int64_t columns_held(bool channel_major) const;
  hid_t id() const { return dataset_; }
  /// Bytes of the unpacked chunks that contain a row.
  std::int64_t row_chunk_bytes(bool channel_major) const;
  /// Sets the size in bytes of the chunk cache, so that no chunk is unpacked twice.
  void set_chunk_cache(hid_t file, std::int64_t bytes);

  /// Reads rows of the columns of a field, as ArrayFile::read() does.
  void read(const Hdf5Field& field, const ArrayBand& band, BandValues& values);

 private:
  Hdf5Dataset() = default;
  bool find_shape();
  const char* find_storage(std::int64_t file_bytes);
  const char* find_chunks(hid_t creation, double item_bytes, double file_bytes);
  std::vector<std::int64_t> written_part(hid_t space, hsize_t written) const;
  bool find_fields(hid_t type);
  bool add_member(hid_t type, unsigned index);
  bool read_block(bool channel_major, std::int64_t first, std::int64_t rows, std::int64_t column,
                  std::int64_t columns, double* to);
  bool read_rows(const Hdf5Field& field, const ArrayBand& band, std::int64_t first, std::int64_t rows,
                 BandValues& values);
  void read_by_chunks(const Hdf5Field& field, const ArrayBand& band, std::int64_t first, std::int64_t rows,
                      BandValues& values);
  bool is_written(bool channel_major, std::int64_t first) const;
  /// The dimension of shape_ that the rows are along.
  std::size_t axis(bool channel_major) const { return shape_.size() > 1 && channel_major != turned_ ? 1 : 0; }

  std::string path_;
  Hdf5Id dataset_, memory_type_;
  std::vector<hsize_t> dimensions_;  ///< all of them
  std::vector<std::size_t> kept_;    ///< indices of those in shape_
  std::vector<std::int64_t> shape_;  ///< as it is stored
  bool turned_ = false;
  std::vector<Hdf5Field> fields_;
  std::size_t numbers_ = 1;  ///< of an element
  Hdf5Storage storage_;
  std::vector<double> block_;
  std::int64_t block_first_ = -1, block_rows_ = 0;  ///< rows in block_, of a dataset of records
};

/// The content of a file.
struct Hdf5Tree {
  std::vector<std::string> datasets;  ///< paths from the root, beginning with '/', in their order
  std::string notes;                  ///< text stored by a written log, else empty
  Issues issues;                      ///< groups that cannot be read
};

/// Walks through the groups; links to other places and files are not followed.
Hdf5Tree hdf5_tree(hid_t file);

/// Sets units and names of the fields of a dataset from its attributes and from the item names that pandas
/// stores.
void describe_hdf5_fields(hid_t file, const std::string& path, Hdf5Dataset& dataset);

/// True when the MATLAB attributes of the dataset declare characters or cells.
bool is_text_of_matlab(hid_t dataset);

}  // namespace faultline
