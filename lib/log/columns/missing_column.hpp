// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// That none of the columns is this channel, and how to name one in the robot file.
std::string missing_column_sentence(const std::vector<std::string>& columns, const std::string& channel,
                                    const std::string& meaning);

}  // namespace faultline
