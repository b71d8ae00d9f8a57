// SPDX-License-Identifier: MIT
#include "lib/log/log_channels.hpp"

#include <array>

namespace faultline {
namespace {

/// In the order of Quantity; the time belongs to no joint.
constexpr std::array kSignals{&Log::q,     &Log::q,      &Log::dq,      &Log::tau,
                              &Log::q_ref, &Log::dq_ref, &Log::tau_ref, &Log::tau_meas};
static_assert(kSignals.size() == static_cast<std::size_t>(Quantity::tau_meas) + 1);

}  // namespace

JointSignals& signals_of(Log& log, Quantity quantity) {
  return log.*kSignals[static_cast<std::size_t>(quantity)];
}
const JointSignals& signals_of(const Log& log, Quantity quantity) {
  return log.*kSignals[static_cast<std::size_t>(quantity)];
}

}  // namespace faultline
