// SPDX-License-Identifier: MIT
#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/arrays/written_arrays.hpp"
#include "formats/bytes/little_endian.hpp"
#include "formats/known_formats.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::string_view kHeaderText = "MATLAB 5.0 MAT-file, written by faultline";
constexpr std::size_t kTextBytes = 116, kFree = 8;  ///< bytes of the header
constexpr std::uint32_t kInt8 = 1, kInt32 = 5, kUint32 = 6, kDouble = 9, kWriterMatrix = 14, kUtf8 = 16;
constexpr std::uint32_t kCharClass = 4, kDoubleClass = 6;
constexpr std::size_t kStep = 8;  ///< elements begin at multiples of this many bytes
constexpr std::size_t kWriterMostBytes = (std::size_t{1} << 31) - 4096;

void pad(std::string& bytes) { bytes.append((kStep - bytes.size() % kStep) % kStep, '\0'); }

/// Returns a matrix without its data, up to the tag of the data.
std::string matrix_head(std::uint32_t kind, std::size_t rows, std::size_t columns, const std::string& name,
                        std::uint32_t data_type, std::size_t data_bytes) {
  std::string head;
  for (const std::uint32_t word :
       {kUint32, std::uint32_t{8}, kind, std::uint32_t{0}, kInt32, std::uint32_t{8}})
    put_number(head, word);
  put_number(head, static_cast<std::uint32_t>(rows));
  put_number(head, static_cast<std::uint32_t>(columns));
  put_number(head, kInt8);
  put_number(head, static_cast<std::uint32_t>(name.size()));
  head += name;
  pad(head);
  put_number(head, data_type);
  put_number(head, static_cast<std::uint32_t>(data_bytes));
  std::string all;
  put_number(all, kWriterMatrix);
  put_number(all, static_cast<std::uint32_t>(head.size() + (data_bytes + kStep - 1) / kStep * kStep));
  return all + head;
}

class MatlabWriter : public LogWriter {
 public:
  explicit MatlabWriter(const std::string& path) : path_(path), file_(path), arrays_(path, "extra_") {}

  void write(const Log& segment) override { arrays_.add(segment, 0, segment.rows()); }
  void note_provenance(const std::string& provenance) override { arrays_.note_provenance(provenance); }

  void commit() override {
    std::string header(kHeaderText);
    header.resize(kTextBytes, ' ');
    header.append(kFree, '\0');
    header += std::string_view("\0\x01IM", 4);
    file_.write(header);
    for (const WrittenArray& array : arrays_.arrays()) write_array(array);
    if (const std::string notes = arrays_.notes(); !notes.empty()) write_notes(notes);
    file_.commit();
  }

 private:
  void write_array(const WrittenArray& array) {
    const auto rows = static_cast<std::size_t>(arrays_.rows()), width = static_cast<std::size_t>(array.width);
    const std::size_t bytes = rows * width * sizeof(double);
    if (bytes > kWriterMostBytes)
      throw Error(ErrorCode::output, path_,
                  "cannot hold \"" + array.name +
                      "\": a .mat file of this version holds at most 2 GiB per array; write .h5, which "
                      "MATLAB reads with h5read()");
    file_.write(matrix_head(kDoubleClass, rows, width, array.name, kDouble, bytes));
    std::vector<double> column(rows);
    for (std::size_t c = 0; c < width; ++c) {
      for (std::size_t row = 0; row < rows; ++row) column[row] = array.values[row * width + c];
      file_.write({reinterpret_cast<const char*>(column.data()), rows * sizeof(double)});
    }
  }

  void write_notes(const std::string& notes) {
    std::string bytes = matrix_head(kCharClass, 1, notes.size(), kNotesName, kUtf8, notes.size()) + notes;
    pad(bytes);
    file_.write(bytes);
  }

  std::string path_;
  AtomicFile file_;
  WrittenArrays arrays_;
};

}  // namespace

std::unique_ptr<LogWriter> create_matlab(const std::string& path) {
  return std::make_unique<MatlabWriter>(path);
}

}  // namespace faultline
