// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/raw_reader.hpp"

namespace faultline {

/// The first rows of a file as it has them; enough to guess what its columns mean.
struct RawExcerpt {
  std::string path;
  bool canonical = false;  ///< the columns are channels in SI, so that nothing is to be guessed of them
  std::vector<RawColumn> columns;           ///< the first 256
  std::vector<std::vector<double>> values;  ///< [column][row]

  std::size_t rows() const;
};

/// Throws Error(input) when the file cannot be read.
RawExcerpt raw_excerpt(const std::string& path);

}  // namespace faultline
