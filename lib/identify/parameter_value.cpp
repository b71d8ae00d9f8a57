// SPDX-License-Identifier: MIT
#include "lib/identify/parameter_value.hpp"

#include <algorithm>

namespace faultline {

ParameterValue value_of(const ParameterEstimate& estimate) {
  return {estimate.name, estimate.value, estimate.std, estimate.unit};
}

const ParameterValue* find_value(const std::vector<ParameterValue>& values, const std::string& name) {
  const auto found = std::find_if(values.begin(), values.end(),
                                  [&](const ParameterValue& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

}  // namespace faultline
