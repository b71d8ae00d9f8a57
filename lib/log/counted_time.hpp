// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// A column of numbers by its name, of the first rows of a log.
struct NamedValues {
  std::string name;
  std::vector<double> values;
};

/// The unit of a time of which none is known.
struct CountedTime {
  const char* unit = "";  ///< "ms", "us", "ns", or empty for s
  std::string why{};      ///< a sentence that says how it was recognised; empty where the unit is s
};

/// A time that counts whole numbers far apart counts no seconds: it counts from 1970 where the sample period
/// then is one, else in the unit in which the velocities are the derivative of the positions, else in the one
/// with a usual sample period.
CountedTime counted_time(const std::vector<double>& time, const std::vector<NamedValues>& columns);

}  // namespace faultline
