// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// Calls `read`, which may refuse its file.
template <typename Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input && error.code() != ErrorCode::usage) throw;
  }
}

/// What a reader promises about what it has read.
inline void demand(bool kept, const char* promise) {
  if (!kept) throw std::logic_error(promise);
}

/// The path of a file that holds the bytes until the next call with this name.
inline std::string file_of(const std::string& name, const std::string& bytes) {
  static const TemporaryFolder folder;
  return folder.write(name, bytes);
}

}  // namespace faultline
