// SPDX-License-Identifier: MIT
#include "lib/balance/likely_states.hpp"

#include <algorithm>
#include <array>

namespace faultline {

std::vector<char> likely_states(const Eigen::MatrixX2d& nats, double price) {
  const Eigen::Index rows = nats.rows();
  std::vector<std::array<bool, 2>> has_changed(rows);
  std::array<double, 2> sum = {0.0, 0.0};
  for (Eigen::Index k = 0; k < rows; ++k) {
    const std::array<double, 2> before = sum;
    for (const int state : {0, 1}) {
      const double stays = before[state], changes = before[1 - state] + price;
      has_changed[k][state] = changes < stays;
      sum[state] = std::min(stays, changes) + nats(k, state);
    }
  }
  std::vector<char> out(rows);
  int state = sum[1] < sum[0] ? 1 : 0;
  for (Eigen::Index k = rows; k-- > 0;) {
    out[k] = static_cast<char>(state);
    if (has_changed[k][state]) state = 1 - state;
  }
  return out;
}

}  // namespace faultline
