// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/raw_reader.hpp"

namespace faultline {

/// The first rows of a file, unchanged; enough to derive the meaning of its columns.
struct RawExcerpt {
  std::string path;
  bool canonical = false;                   ///< the columns are channels in SI and need no guess
  std::vector<RawColumn> columns;           ///< the first 256
  std::vector<std::vector<double>> values;  ///< [column][row]

  std::size_t rows() const;
};

/// Throws Error(input) when the file cannot be read.
RawExcerpt raw_excerpt(const std::string& path);

}  // namespace faultline
