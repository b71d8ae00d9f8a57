// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Estimate of a parameter by one identification, without its reasons, to be stored and compared with that of
/// another identification.
struct ParameterValue {
  std::string name;  ///< of ParameterEstimate
  double value = std::numeric_limits<double>::quiet_NaN();
  double std = std::numeric_limits<double>::quiet_NaN();  ///< NaN if not identifiable
  std::string unit;
};

ParameterValue value_of(const ParameterEstimate& estimate);
/// Returns the value of that name; null if there is none.
const ParameterValue* find_value(const std::vector<ParameterValue>& values, const std::string& name);

}  // namespace faultline
