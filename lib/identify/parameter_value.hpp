// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/identify/identification.hpp"

namespace faultline {

/// What one identification says of a parameter, without its reasons: to be kept and compared with what
/// another one says.
struct ParameterValue {
  std::string name;  ///< of ParameterEstimate
  double value = std::numeric_limits<double>::quiet_NaN();
  double std = std::numeric_limits<double>::quiet_NaN();  ///< NaN when not identifiable
  std::string unit;
};

ParameterValue value_of(const ParameterEstimate& estimate);
/// The value of that name; null when there is none.
const ParameterValue* find_value(const std::vector<ParameterValue>& values, const std::string& name);

}  // namespace faultline
