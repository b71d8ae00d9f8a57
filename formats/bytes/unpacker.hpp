// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/bytes/file_bytes.hpp"

namespace faultline {

/// The bytes inside a file that is compressed as a whole, from front to back, in memory of fixed size.
class Unpacker {
 public:
  virtual ~Unpacker() = default;
  virtual const char* name() const = 0;
  /// Usual time to unpack a byte, ns.
  virtual double byte_ns() const = 0;
  /// Copies up to `size` of the next bytes to `to`; 0 at their end or at damage.
  virtual std::size_t read(char* to, std::size_t size) = 0;
  /// After the end: what was wrong with the compressed bytes and its effect; empty for nothing.
  virtual const std::string& damage() const = 0;
};

/// Returns an unpacker for a file that begins as gzip or zstd, which reads from its beginning; null for any
/// other. `file` must outlive it.
std::unique_ptr<Unpacker> unpacker_of(FileBytes& file);

}  // namespace faultline
