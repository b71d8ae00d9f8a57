// SPDX-License-Identifier: MIT
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

template <typename AnyLog>
auto& signals_in(AnyLog& log, Quantity quantity) {
  switch (quantity) {
    case Quantity::dq:
      return log.dq;
    case Quantity::tau:
      return log.tau;
    case Quantity::q_ref:
      return log.q_ref;
    case Quantity::dq_ref:
      return log.dq_ref;
    case Quantity::tau_ref:
      return log.tau_ref;
    case Quantity::tau_meas:
      return log.tau_meas;
    case Quantity::time:  // belongs to no joint
    case Quantity::q:
      break;
  }
  return log.q;
}

}  // namespace

JointSignals& signals_of(Log& log, Quantity quantity) { return signals_in(log, quantity); }
const JointSignals& signals_of(const Log& log, Quantity quantity) { return signals_in(log, quantity); }

}  // namespace faultline
