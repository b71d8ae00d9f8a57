// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "formats/bytes/unpacker.hpp"

namespace faultline {

/// Several gzip members may follow each other.
std::unique_ptr<Unpacker> unpack_gzip(FileBytes& file);

}  // namespace faultline
