// SPDX-License-Identifier: MIT
#include "lib/batch/page/packed.hpp"

#include <zlib.h>

#include <cstdint>
#include <new>
#include <vector>

#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr int kGzipWindow = 15 + 16;  // the largest window of deflate, and 16 for the gzip wrapper
constexpr int kMemory = 8;            // zlib's default

}  // namespace

std::string packed(std::string_view text) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::vector<std::uint8_t> bytes(deflateBound(&stream, text.size()));
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);  // ends at once: the output has room for any text
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return base64(bytes);
}

}  // namespace faultline
