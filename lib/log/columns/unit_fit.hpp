// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/channels.hpp"
#include "lib/log/column_families.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/units.hpp"

/// Columns in a known unit of the wrong dimension, such as a current in the place of a torque.
namespace faultline {

/// Returns the quantity of the same kind that every log may have: q for q_ref, tau for tau_ref and tau_meas.
constexpr Quantity basic_quantity(Quantity quantity) {
  if (quantity == Quantity::q_ref) return Quantity::q;
  if (quantity == Quantity::dq_ref) return Quantity::dq;
  return quantity == Quantity::tau_ref || quantity == Quantity::tau_meas ? Quantity::tau : quantity;
}

/// Whether the quantity can have that dimension; it can if there is no unit.
bool measures(Dimension dimension, Quantity quantity);

/// Returns the factor to SI of the unit in `spec`; 1 without one. Throws Error(usage) for an unknown unit and
/// for a sign other than +1 and -1.
double checked_factor(const ColumnSpec& spec, const std::string& channel);

/// Throws Error(input), or Error(usage) for a unit of the robot file, if the column has another dimension
/// than the channel and `spec` gives no scale; the message states what to write into the robot file.
void refuse_misfit(const RawColumn& column, const ColumnSpec& spec, Channel channel, const std::string& path);

/// Removes and returns the families in another dimension for which `map` has neither unit nor scale.
std::vector<ColumnFamily> take_mismatched(std::vector<ColumnFamily>& families,
                                          const std::vector<RawColumn>& columns, const ColumnMap& map);

/// Returns a sentence on why such a column was not used, for an issue.
std::string not_taken_sentence(const RawColumn& column, Quantity quantity);

}  // namespace faultline
