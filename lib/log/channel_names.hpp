// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <string>
#include <vector>

namespace faultline {

enum class Quantity { time, q, dq, tau, q_ref, dq_ref, tau_ref, tau_meas };

/// What is recorded of each joint, in the order of a log's columns.
inline constexpr std::array kJointQuantities{Quantity::q,       Quantity::dq,     Quantity::tau,
                                             Quantity::q_ref,   Quantity::dq_ref, Quantity::tau_ref,
                                             Quantity::tau_meas};

/// Whether it is a torque or force: the joint's, commanded or measured.
constexpr bool is_torque(Quantity quantity) {
  return quantity == Quantity::tau || quantity == Quantity::tau_ref || quantity == Quantity::tau_meas;
}

/// A canonical channel: a quantity of a joint, which counts from 1; 0 for the time.
struct Channel {
  Quantity quantity = Quantity::time;
  int joint = 0;

  auto operator<=>(const Channel&) const = default;
};

/// "t", "q1", "dq2", "tau3", "q_ref1", "dq_ref1", "tau_ref1", "tau_meas1".
std::string to_string(Channel channel);
/// What a canonical name means; nullopt for any other name.
std::optional<Channel> canonical_channel(const std::string& name);
/// "position", "velocity" and so on, for messages.
const char* meaning_of(Quantity quantity);

/// What a name such as "actual_q_0" or "/joint_states/position[2]" seems to mean.
struct NameReading {
  std::string stem;  ///< the name with '#' for its number: names that differ by the number only share it
  std::optional<int> number;
  std::optional<Quantity> quantity;  ///< nullopt when it says none, or is an error, limit, acceleration ...
  int fitness = 0;                   ///< how well it fits, to choose among several columns of one quantity
  /// The words, numbers included, that say neither quantity nor how it was measured: a joint's name, perhaps.
  std::string joint{};
  int as_torque = 0;  ///< how well a torque of any meaning fits as the only torque of a log
};
NameReading read_name(const std::string& name);

/// Index of the column that looks like the time, -1 for none.
int find_time_column(const std::vector<std::string>& names);

}  // namespace faultline
