// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// One column of a log to be written. The values belong to the log.
struct WrittenChannel {
  std::string name;
  std::string unit;  ///< empty for canonical channels, which are SI
  const std::vector<double>* values = nullptr;
};

/// Returns the columns of a log in the order t, q1.., dq1.., tau1.., q_ref1.., dq_ref1.., tau_ref1..,
/// tau_meas1.., extra; an extra channel with a canonical name gets the prefix "other_".
std::vector<WrittenChannel> channels_of(const Log& log);

}  // namespace faultline
