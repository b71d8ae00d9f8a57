// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

namespace faultline {

/// The step in which a channel's values lie, as that of an encoder or of a printed decimal, from the first
/// few thousand changes of the value.
class ValueStep {
 public:
  void add_change(double change);
  /// Nullopt when the changes are no multiples of one step, or too few.
  std::optional<double> result() const;

 private:
  std::vector<double> changes_;  ///< sizes
};

}  // namespace faultline
