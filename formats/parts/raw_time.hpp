// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Where a file has its time.
struct RawTime {
  int column = -1;
  int nanoseconds = -1;  ///< second column of a time in seconds and nanoseconds; -1 for none
  double factor = 1.0;   ///< to s

  double at(const RawBlock& block, int row) const;
};

/// Told by the file, else by the names of its columns; nullopt for none.
std::optional<RawTime> find_raw_time(const std::vector<RawColumn>& columns);

}  // namespace faultline
