// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"

namespace faultline {

class Issues;

enum class Quantity { time, q, dq, tau, q_ref, dq_ref, tau_ref, tau_meas };

/// The quantities of a joint that a log can record, in the order of its columns.
inline constexpr std::array kJointQuantities{Quantity::q,       Quantity::dq,     Quantity::tau,
                                             Quantity::q_ref,   Quantity::dq_ref, Quantity::tau_ref,
                                             Quantity::tau_meas};

/// Whether the quantity is a torque or force of a joint, commanded or measured.
constexpr bool is_torque(Quantity quantity) {
  return quantity == Quantity::tau || quantity == Quantity::tau_ref || quantity == Quantity::tau_meas;
}

/// A canonical channel: a quantity and a joint; no joint for the time.
struct Channel {
  Quantity quantity = Quantity::time;
  Joint joint{};

  auto operator<=>(const Channel&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Returns the canonical name: "t", "q1", "dq2", "tau3", "q_ref1", "dq_ref1", "tau_ref1", "tau_meas1".
std::string to_string(Channel channel);
/// Returns the channel of a canonical name; nullopt for any other name.
std::optional<Channel> canonical_channel(const std::string& name);
/// Returns the quantity in words, such as "position" or "velocity", for messages.
const char* meaning_of(Quantity quantity);

/// Interpretation of a column name such as "actual_q_0" or "/joint_states/position[2]".
struct ParsedName {
  std::string stem;  ///< name with '#' for its number: the same for names that differ by the number only
  std::optional<int> number;
  std::optional<Quantity> quantity;  ///< nullopt if the name has none, or is an error, limit, acceleration
  int fitness = 0;                   ///< how well it fits, to choose among several columns of one quantity
  /// Words, with numbers, that name neither the quantity nor how it was measured; perhaps a joint's name.
  std::string joint{};
  int as_torque = 0;  ///< how well the column fits as the only torque of a log, commanded or measured
};
ParsedName parse_name(const std::string& name);

/// Returns the index of the column whose name fits the time best; -1 for none.
int find_time_column(const std::vector<std::string>& names);

/// Returns why a log with `found` positions does not fit `whose` robot (such as "the model") of `wanted`
/// joints: the position without a column if the log's issues name one, else perhaps another robot.
std::string joint_count_sentence(const Issues& issues, int found, const std::string& whose, int wanted);

}  // namespace faultline
