// SPDX-License-Identifier: MIT
#include "formats/bytes/unpacker.hpp"

#include <string_view>

#include "formats/bytes/gzip_unpacker.hpp"
#include "formats/bytes/zstd_unpacker.hpp"

namespace faultline {
namespace {

constexpr std::string_view kGzipMagic = "\x1F\x8B\x08";
constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

}  // namespace

std::unique_ptr<Unpacker> unpacker_of(FileBytes& file) {
  if (file.head().starts_with(kGzipMagic)) return unpack_gzip(file);
  if (file.head().starts_with(kZstdMagic)) return unpack_zstd(file);
  return nullptr;
}

}  // namespace faultline
