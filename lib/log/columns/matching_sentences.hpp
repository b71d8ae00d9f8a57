// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lib/log/column_families.hpp"

namespace faultline {

/// That none of the columns is this channel, and how to name one in the robot file.
std::string missing_column_sentence(const std::vector<std::string>& columns, const std::string& channel,
                                    const std::string& meaning);

/// That a joint has no position, though the column `later` shows that the log has it or a later one, and how
/// to name one in the robot file.
std::string missing_joint_sentence(const std::vector<std::string>& columns, int joint,
                                   const std::string& later);

/// That the header of a column has a unit that is not known.
std::string unknown_unit_sentence(const std::string& column, const std::string& unit,
                                  const std::string& channel);

/// Which column was taken as a quantity, and which others could be meant; empty when there are none.
std::string rivals_sentence(const std::vector<std::string>& columns,
                            const std::vector<ColumnFamily>& families, Quantity quantity,
                            const ColumnFamily& chosen);

/// In which order joints that have words for names were taken.
std::string joint_order_sentence(const std::vector<std::string>& columns,
                                 const std::vector<std::pair<Channel, int>>& joints);

}  // namespace faultline
