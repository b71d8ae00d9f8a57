// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// Name and values of a column in the first rows of a log.
struct NamedValues {
  std::string name;
  std::vector<double> values;
};

/// The unit of a time for which the file gives none.
struct CountedTime {
  const char* unit = "";  ///< "ms", "us", "ns", or empty for s
  std::string why{};      ///< a sentence on how it was recognised; empty if the unit is s or counts from 1970
};

/// Returns the unit of a time of whole numbers: the one that counts from 1970 if it gives a usual sample
/// period, else the one in which the velocities are the derivatives of the positions, else the one with a
/// usual sample period; s for any other time.
CountedTime counted_time(const std::vector<double>& time, const std::vector<NamedValues>& columns);

}  // namespace faultline
