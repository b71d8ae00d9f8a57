// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_residual.hpp"

#include <cmath>

#include "lib/log/log_channels.hpp"

namespace faultline {

bool RelationResidual::inputs_are_known() const {
  for (std::size_t i = 0; i < relation_.input_low.size(); ++i) {
    const double value = line_.value(static_cast<int>(i));
    if (value < relation_.input_low[i] || value > relation_.input_high[i]) return false;
  }
  return true;
}

std::optional<RelationSample> RelationResidual::take(const Log& log, int row) {
  const double target = signals_of(log, relation_.target)[relation_.joint][row];
  if (!line_.take(log, row) || !std::isfinite(target) || !inputs_are_known()) return std::nullopt;
  double predicted = 0.0;
  for (std::size_t i = 0; i < relation_.weights.size(); ++i)
    predicted += relation_.weights[i] * line_.terms()[i];
  const bool above = target >= relation_.high && predicted >= relation_.high;
  const bool below = target <= relation_.low && predicted <= relation_.low;
  return RelationSample{log.time[row], predicted, above || below ? 0.0 : target - predicted};
}

}  // namespace faultline
