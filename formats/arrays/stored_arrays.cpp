// SPDX-License-Identifier: MIT
#include "formats/arrays/stored_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "formats/bytes/little_endian.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Compressed contents are unpacked into memory while their total stays below this; larger ones are streamed.
constexpr std::int64_t kMostUnpacked = 96 << 20;
constexpr std::int64_t kRegionBytes = 16 << 20;     ///< read at once
constexpr std::size_t kMostRegionBytes = 64 << 20;  ///< of one row, or of a column of few rows
constexpr std::size_t kPiece = 1 << 20;

/// Converts elements that lie `stride` bytes apart from `from` on to doubles. `swapped` when their byte order
/// is not the processor's.
template <typename Element>
void decode_as(const char* from, std::ptrdiff_t stride, bool swapped, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i, from += stride) {
    std::array<char, sizeof(Element)> bytes;
    std::memcpy(bytes.data(), from, sizeof(Element));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    Element element;
    std::memcpy(&element, bytes.data(), sizeof element);
    to[i] = static_cast<double>(element);
  }
}

/// The size of an element, and the conversion to doubles of elements that lie `stride` bytes apart.
struct ElementFacts {
  std::size_t size;
  void (*decode)(const char* from, std::ptrdiff_t stride, bool swapped, std::size_t count, double* to);
};

template <typename Element>
constexpr ElementFacts kFactsOf{sizeof(Element), decode_as<Element>};

/// In the order of ElementType.
constexpr ElementFacts kElements[] = {
    kFactsOf<float>,         kFactsOf<double>,       kFactsOf<std::int8_t>,  kFactsOf<std::int16_t>,
    kFactsOf<std::int32_t>,  kFactsOf<std::int64_t>, kFactsOf<std::uint8_t>, kFactsOf<std::uint16_t>,
    kFactsOf<std::uint32_t>, kFactsOf<std::uint64_t>};

const ElementFacts& facts_of(ElementType type) { return kElements[static_cast<std::size_t>(type)]; }

/// Memory layout of a two-dimensional array: bytes between its rows, and between its columns.
struct Lie {
  std::int64_t row_stride = 0, column_stride = 0, rows = 0, columns = 1;
  bool by_rows() const { return columns == 1 || column_stride <= row_stride; }
};

Lie lie_of(const StoredArray& stored, bool channel_major) {
  std::vector<std::int64_t> shape = stored.array.shape, strides = stored.strides;
  for (std::size_t i = shape.size(); i-- > 0 && shape.size() > 2;)
    if (shape[i] == 1) {
      shape.erase(shape.begin() + static_cast<std::ptrdiff_t>(i));
      strides.erase(strides.begin() + static_cast<std::ptrdiff_t>(i));
    }
  const auto item = static_cast<std::int64_t>(size_of(stored.type));
  if (shape.empty()) return {item, item, 1, 1};
  if (shape.size() == 1) return {strides[0], strides[0], shape[0], 1};
  return channel_major ? Lie{strides[1], strides[0], shape[1], shape[0]}
                       : Lie{strides[0], strides[1], shape[0], shape[1]};
}

std::int64_t whole(std::int64_t bytes, std::int64_t stride, std::int64_t most) {
  return bytes < 0 ? 0 : stride <= 0 ? most : std::min(most, bytes / stride + 1);
}

}  // namespace

std::size_t size_of(ElementType type) { return facts_of(type).size; }

std::vector<std::int64_t> packed_strides(const std::vector<std::int64_t>& shape, std::int64_t item,
                                         bool fortran_order) {
  std::vector<std::int64_t> strides(shape.size());
  std::int64_t stride = item;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const std::size_t at = fortran_order ? i : shape.size() - 1 - i;
    strides[at] = stride;
    stride *= std::max<std::int64_t>(shape[at], 1);
  }
  return strides;
}

StoredArrays::StoredArrays(std::unique_ptr<RandomFile> file, StoredList list)
    : file_(std::move(file)),
      contents_(std::move(list.contents)),
      stored_(std::move(list.arrays)),
      memory_left_(kMostUnpacked) {
  issues_ = std::move(list.issues);
  notes_ = std::move(list.notes);
  for (const StoredArray& stored : stored_) {
    arrays_.push_back(stored.array);
    const std::int64_t bytes = most_bytes(contents_[stored.content]) - stored.begin - stored.in_record -
                               static_cast<std::int64_t>(size_of(stored.type));
    const StoredArray copy = stored;
    arrays_.back().rows_held = [bytes, copy](bool channel_major) {
      const Lie lie = lie_of(copy, channel_major);
      const std::int64_t last = lie.by_rows() ? (lie.columns - 1) * lie.column_stride : 0;
      return whole(bytes - last, lie.row_stride, lie.rows);
    };
    arrays_.back().columns_held = [bytes, copy](bool channel_major) {
      const Lie lie = lie_of(copy, channel_major);
      if (lie.by_rows()) return lie.columns;
      const std::int64_t all = whole(bytes - (lie.rows - 1) * lie.row_stride, lie.column_stride, lie.columns);
      return std::max<std::int64_t>(all, bytes >= 0 ? 1 : 0);
    };
  }
}

/// Returns the whole unpacked content, or null when it is plain or would take too much memory.
const std::string* StoredArrays::in_memory(std::size_t content) {
  const StoredContent& what = contents_[content];
  if (what.packing == Packing::plain) return nullptr;
  if (const auto known = unpacked_.find(content); known != unpacked_.end()) return &known->second;
  if (most_bytes(what) > memory_left_) return nullptr;
  std::string& bytes = unpacked_[content];
  ContentStream stream(*file_, what);
  const auto most = static_cast<std::size_t>(most_bytes(what));
  for (std::size_t got = 1; got > 0 && bytes.size() < most;) {
    const std::size_t before = bytes.size();
    bytes.resize(std::min(most, before + std::max(kPiece, before / 2)));
    got = stream.read(static_cast<std::int64_t>(before), bytes.data() + before, bytes.size() - before);
    bytes.resize(before + got);
  }
  char beyond = 0;
  stream.read(static_cast<std::int64_t>(bytes.size()), &beyond, 1);  // to the end mark of the stream
  if (stream.mismatch()) report_mismatch(what.name);
  memory_left_ -= static_cast<std::int64_t>(bytes.size());
  return &bytes;
}

/// Reads bytes of a content into region_.
void StoredArrays::fetch(std::size_t content, StreamKey key, std::int64_t at, std::size_t count) {
  if (region_.content == content && region_.at == at && region_.wanted == count) return;
  region_.content = content;
  region_.at = at;
  region_.wanted = count;
  if (count > kMostRegionBytes)
    file_->fail(
        fmt::format("has records of {} MiB, more than the {} MiB that can be read at once; save each "
                    "column of the log as a separate array",
                    count >> 20, kMostRegionBytes >> 20));
  region_.bytes.resize(std::max(region_.bytes.size(), count));
  if (const std::string* bytes = in_memory(content)) {
    const auto begin = std::min(static_cast<std::size_t>(at), bytes->size());
    region_.got = std::min(count, bytes->size() - begin);
    std::copy_n(bytes->data() + begin, region_.got, region_.bytes.data());
    return;
  }
  ContentStream& stream = streams_.try_emplace(key, *file_, contents_[content]).first->second;
  region_.got = stream.read(at, region_.bytes.data(), count);
}

void StoredArrays::read_by_rows(const ArrayBand& band, BandValues& values) {
  const StoredArray& stored = stored_[band.array];
  const Lie lie = lie_of(stored, band.channel_major);
  const std::int64_t item = static_cast<std::int64_t>(size_of(stored.type));
  const std::int64_t last = stored.in_record + (lie.columns - 1) * lie.column_stride + item;
  const std::int64_t at_once =
      std::max<std::int64_t>(1, kRegionBytes / std::max<std::int64_t>(1, lie.row_stride));
  for (std::int64_t done = 0; done < band.rows;) {
    const std::int64_t rows = std::min(at_once, band.rows - done);
    const std::int64_t at = stored.begin + (band.first_row + done) * lie.row_stride;
    const std::int64_t limit = most_bytes(contents_[stored.content]) - at;
    const std::int64_t wanted = std::min(limit, (rows - 1) * lie.row_stride + std::max(lie.row_stride, last));
    fetch(stored.content, {band.array, -1}, at, static_cast<std::size_t>(wanted));
    const std::int64_t got = whole(static_cast<std::int64_t>(region_.got) - last, lie.row_stride, rows);
    for (std::size_t i = 0; i < band.columns.size(); ++i)
      facts_of(stored.type)
          .decode(region_.bytes.data() + stored.in_record + band.columns[i] * lie.column_stride,
                  lie.row_stride, stored.swapped, static_cast<std::size_t>(got),
                  values.columns[i].data() + done);
    if (got < rows) {
      values.lost.push_back({done + got, band.rows - done - got});
      return;
    }
    done += rows;
  }
}

void StoredArrays::read_by_columns(const ArrayBand& band, BandValues& values) {
  const StoredArray& stored = stored_[band.array];
  const Lie lie = lie_of(stored, band.channel_major);
  const std::int64_t item = static_cast<std::int64_t>(size_of(stored.type));
  for (std::size_t i = 0; i < band.columns.size(); ++i) {
    const std::int64_t at = stored.begin + stored.in_record + band.columns[i] * lie.column_stride +
                            band.first_row * lie.row_stride;
    const std::int64_t wanted = (band.rows - 1) * lie.row_stride + item;
    fetch(stored.content, {band.array, band.columns[i]}, at, static_cast<std::size_t>(wanted));
    const std::int64_t got = whole(static_cast<std::int64_t>(region_.got) - item, lie.row_stride, band.rows);
    facts_of(stored.type)
        .decode(region_.bytes.data(), lie.row_stride, stored.swapped, static_cast<std::size_t>(got),
                values.columns[i].data());
    if (got < band.rows) values.lost.push_back({got, band.rows - got, static_cast<int>(i)});
  }
}

void StoredArrays::read(const ArrayBand& band, BandValues& values) {
  const StoredArray& stored = stored_[band.array];
  if (lie_of(stored, band.channel_major).by_rows())
    read_by_rows(band, values);
  else
    read_by_columns(band, values);
  if (!stored.is_moment) return;
  constexpr auto kNone = static_cast<double>(std::numeric_limits<std::int64_t>::min());
  for (std::vector<double>& column : values.columns)
    std::replace(column.begin(), column.end(), kNone, std::numeric_limits<double>::quiet_NaN());
}

void StoredArrays::report_mismatch(const std::string& name) {
  issues_.add(make_issue(
      "checksum_mismatch", Severity::severe,
      fmt::format("the checksum of \"{}\" does not match its numbers; some of them are wrong, but the file "
                  "does not show which",
                  shortened(name, kLongestName)),
      name));
}

/// Checks the contents that were not unpacked in one piece.
void StoredArrays::finish() {
  std::vector<char> piece(kPiece);
  for (std::size_t i = 0; i < contents_.size(); ++i) {
    const StoredContent& content = contents_[i];
    if (!content.crc || content.packing != Packing::plain) continue;
    ContentStream stream(*file_, content);
    std::uint32_t crc = 0;
    std::int64_t at = 0;
    for (std::size_t got; (got = stream.read(at, piece.data(), piece.size())) > 0;
         at += static_cast<std::int64_t>(got))
      crc = crc32_of({piece.data(), got}, crc);
    if (crc != *content.crc) report_mismatch(content.name);
  }
  for (auto& [key, stream] : streams_)
    if (stream.mismatch()) report_mismatch(contents_[stored_[key.first].content].name);
}

}  // namespace faultline
