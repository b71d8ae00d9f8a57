// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "formats/bytes/unpacker.hpp"

namespace faultline {

/// Several zstd frames may follow each other.
std::unique_ptr<Unpacker> unpack_zstd(FileBytes& file);

}  // namespace faultline
