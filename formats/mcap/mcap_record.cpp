// SPDX-License-Identifier: MIT
#include "formats/mcap/mcap_record.hpp"

#include <zlib.h>

namespace faultline {

std::uint32_t mcap_crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace faultline
