// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/channels.hpp"
#include "lib/log/column_families.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/units.hpp"

/// Columns in a known unit that cannot be their quantity's, such as a current where a torque belongs.
namespace faultline {

/// Whether numbers in that dimension can be the quantity's as they are; without a unit any can.
bool measures(Dimension dimension, Quantity quantity);

/// To SI, of the unit that `spec` gives; 1 without one. Throws Error(usage) for a unit that is not known and
/// for a sign that is none.
double checked_factor(const ColumnSpec& spec, const std::string& channel);

/// Throws Error(input), or Error(usage) for a unit of the robot file, when the channel's numbers are in
/// another dimension and `spec` gives no scale; the message says what to write into the robot file.
void refuse_misfit(const RawColumn& column, const ColumnSpec& spec, Channel channel, const std::string& path);

/// Takes out of `families` those in another dimension for which the map has neither unit nor scale.
std::vector<ColumnFamily> take_misfits(std::vector<ColumnFamily>& families,
                                       const std::vector<RawColumn>& columns, const ColumnMap& map);

/// Why such a column was not taken, for an issue.
std::string not_taken_sentence(const RawColumn& column, Quantity quantity);

}  // namespace faultline
