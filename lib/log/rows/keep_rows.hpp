// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

/// Leaves the values of these rows, which increase; a channel without values stays so.
inline void keep_rows(std::vector<double>& values, const std::vector<int>& kept) {
  if (values.empty()) return;
  for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
  values.resize(kept.size());
}

}  // namespace faultline
