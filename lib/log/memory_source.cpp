// SPDX-License-Identifier: MIT
#include "lib/log/memory_source.hpp"

#include <algorithm>

namespace faultline {

MemorySource::MemorySource(Log log, std::string name, int segment_rows)
    : log_(std::move(log)), segment_rows_(std::max(segment_rows, 1)) {
  identity_.path = std::move(name);
  identity_.format = "memory";
  identity_.rows_read = log_.rows();
}

bool MemorySource::next(Log& segment) {
  if (position_ >= log_.rows()) return false;
  const int end = std::min(position_ + segment_rows_, log_.rows());
  segment = slice(log_, position_, end);
  position_ = end;
  return true;
}

}  // namespace faultline
