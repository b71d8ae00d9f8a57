// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// The same figure of each seed's score.
template <typename Figure>
Measured of_seeds(const std::vector<const AlarmScore*>& scores, const Figure& figure) {
  Measured measured;
  for (const AlarmScore* score : scores) measured.by_seed.push_back(figure(*score));
  return measured;
}

}  // namespace faultline
