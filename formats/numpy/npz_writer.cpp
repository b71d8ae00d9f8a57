// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <string_view>

#include "formats/arrays/written_arrays.hpp"
#include "formats/bytes/little_endian.hpp"
#include "formats/known_formats.hpp"
#include "formats/numpy/npy_header.hpp"
#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

constexpr std::uint16_t kVersion = 45;         ///< of zip: with numbers of 64 bits
constexpr std::uint16_t kDate = (1 << 5) | 1;  ///< the first day that zip can store, in every file
constexpr std::uint32_t kIn64 = 0xffffffff;
constexpr std::size_t kHeaderStep = 64;  ///< npy headers end at a multiple of it

std::string npy_header(const WrittenArray& array, std::int64_t rows) {
  const std::string shape =
      array.vector ? fmt::format("({},)", rows) : fmt::format("({}, {})", rows, array.width);
  std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  std::string header(kNpyMagic);
  put_number(header, std::uint16_t{1});
  const std::size_t before = header.size() + sizeof(std::uint16_t);
  text.append(kHeaderStep - (before + text.size() + 1) % kHeaderStep, ' ');
  text += '\n';
  put_number(header, static_cast<std::uint16_t>(text.size()));
  return header + text;
}

class NpzWriter : public LogWriter {
 public:
  explicit NpzWriter(const std::string& path) : file_(path), arrays_(path, "extra/") {}

  void write(const Log& segment) override { arrays_.add(segment, 0, segment.rows()); }
  void note_provenance(const std::string& provenance) override { arrays_.note_provenance(provenance); }

  void commit() override {
    for (const WrittenArray& array : arrays_.arrays())
      add(array.name + ".npy", npy_header(array, arrays_.rows()),
          {reinterpret_cast<const char*>(array.values.data()), array.values.size() * sizeof(double)});
    if (const std::string notes = arrays_.notes(); !notes.empty()) add("faultline.json", notes, {});
    end();
    file_.commit();
  }

 private:
  void add(const std::string& name, std::string_view header, std::string_view values) {
    const std::uint64_t size = header.size() + values.size();
    const std::uint32_t crc = crc32_of(values, crc32_of(header));
    std::string common;
    for (const std::uint16_t field : {kVersion, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, kDate})
      put_number(common, field);
    put_number(common, crc);
    for (int i = 0; i < 2; ++i) put_number(common, kIn64);
    put_number(common, static_cast<std::uint16_t>(name.size()));
    std::string local = "PK\x03\x04" + common, extra;
    put_number(extra, std::uint16_t{1});
    put_number(extra, static_cast<std::uint16_t>(2 * sizeof size));
    for (int i = 0; i < 2; ++i) put_number(extra, size);
    put_number(local, static_cast<std::uint16_t>(extra.size()));
    list(common, name, size);
    write_bytes(local + name + extra);
    write_bytes(header);
    write_bytes(values);
  }

  /// Adds the member to the directory.
  void list(const std::string& common, const std::string& name, std::uint64_t size) {
    directory_ += "PK\x01\x02";
    put_number(directory_, kVersion);
    directory_ += common;
    put_number(directory_, static_cast<std::uint16_t>(4 + 3 * sizeof size));
    directory_.append(10, '\0');  // comment, disk, attributes
    put_number(directory_, kIn64);
    directory_ += name;
    put_number(directory_, std::uint16_t{1});
    put_number(directory_, static_cast<std::uint16_t>(3 * sizeof size));
    for (const std::uint64_t number : {size, size, written_}) put_number(directory_, number);
    ++members_;
  }

  void end() {
    const std::uint64_t at = written_, size = directory_.size();
    std::string bytes = directory_ + "PK\x06\x06";
    put_number(bytes, std::uint64_t{44});  // bytes of this record that follow
    for (int i = 0; i < 2; ++i) put_number(bytes, kVersion);
    put_number(bytes, std::uint64_t{0});
    for (const std::uint64_t number : {members_, members_, size, at}) put_number(bytes, number);
    bytes += "PK\x06\x07";
    put_number(bytes, std::uint32_t{0});
    put_number(bytes, at + size);
    put_number(bytes, std::uint32_t{1});
    bytes += "PK\x05\x06";
    put_number(bytes, std::uint32_t{0});
    for (int i = 0; i < 2; ++i) put_number(bytes, static_cast<std::uint16_t>(members_));
    for (int i = 0; i < 2; ++i) put_number(bytes, kIn64);
    put_number(bytes, std::uint16_t{0});
    write_bytes(bytes);
  }

  void write_bytes(std::string_view bytes) {
    file_.write(bytes);
    written_ += bytes.size();
  }

  AtomicFile file_;
  WrittenArrays arrays_;
  std::string directory_;
  std::uint64_t members_ = 0, written_ = 0;
};

}  // namespace

std::unique_ptr<LogWriter> create_npz(const std::string& path) { return std::make_unique<NpzWriter>(path); }

}  // namespace faultline
