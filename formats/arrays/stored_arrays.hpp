// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "formats/arrays/stored_content.hpp"

namespace faultline {

enum class ElementType { f4, f8, i1, i2, i4, i8, u1, u2, u4, u8 };

std::size_t size_of(ElementType type);

/// An array whose elements have constant strides in a content.
struct StoredArray {
  NamedArray array;  ///< with as many dimensions as `strides`
  std::size_t content = 0;
  std::int64_t begin = 0;             ///< of the first record, in the unpacked content
  std::int64_t in_record = 0;         ///< of the element in its record
  std::vector<std::int64_t> strides;  ///< bytes from element to element along each dimension
  ElementType type = ElementType::f8;
  bool swapped = false;    ///< the byte order is not the processor's
  bool is_moment = false;  ///< times, whose least integer means missing (numpy's NaT)
};

/// The content of a file of stored arrays, as the parser of the format finds it.
struct StoredList {
  std::vector<StoredContent> contents;
  std::vector<StoredArray> arrays;
  Issues issues;
  std::string notes;
};

/// Returns the strides, in bytes, of an array without gaps.
std::vector<std::int64_t> packed_strides(const std::vector<std::int64_t>& shape, std::int64_t item,
                                         bool fortran_order);

class StoredArrays : public ArrayFile {
 public:
  StoredArrays(std::unique_ptr<RandomFile> file, StoredList list);

  void read(const ArrayBand& band, BandValues& values) override;
  void finish() override;

 private:
  struct Region {
    std::size_t content = 0;
    std::int64_t at = -1;
    std::size_t wanted = 0, got = 0;
    std::vector<char> bytes;
  };
  using StreamKey = std::pair<std::size_t, std::int64_t>;  ///< array, and the column of one stored by columns

  void fetch(std::size_t content, StreamKey key, std::int64_t at, std::size_t count);
  const std::string* in_memory(std::size_t content);
  void read_by_rows(const ArrayBand& band, BandValues& values);
  void read_by_columns(const ArrayBand& band, BandValues& values);
  void report_mismatch(const std::string& name);

  std::unique_ptr<RandomFile> file_;
  const std::vector<StoredContent> contents_;
  const std::vector<StoredArray> stored_;
  std::map<StreamKey, ContentStream> streams_;
  std::map<std::size_t, std::string> unpacked_;  ///< whole contents; their total size is bounded
  std::int64_t memory_left_;
  Region region_;
};

}  // namespace faultline
