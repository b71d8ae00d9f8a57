// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/coarse_price.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/hypothesis_prices.hpp"

namespace faultline {
namespace {

constexpr double kCodesMove = 1e12;    // nats of a stuck encoder whose codes do not repeat
constexpr double kUnreadSample = 0.7;  // nats of each sample that a stuck encoder excludes
int repeats_from(const CoarseLog& log, int j, int from) {
  int same = 0;
  for (int k = std::max(1, from); k < log.samples(); ++k) same += log.log.q(k, j) == log.log.q(k - 1, j);
  return same;
}

/// Returns the share of the samples from `from` on, without two, that repeat the position before.
double share_repeated(const CoarseLog& log, int j, int from) {
  const int first = std::min(from + 2, log.samples() - 1);
  return log.samples() - from > 3 ? static_cast<double>(repeats_from(log, j, first)) / (log.samples() - first)
                                  : 0.0;
}

/// Returns the nats of a first false code that does not repeat the last true one: it may be any position that
/// the joint passed since, while a true measurement lies within its noise.
double price_of_new_code(const CoarseLog& log, int j, int from) {
  if (from < 1) return 0.0;
  const double passed = std::abs(log.log.q(from, j) - log.log.q(from - 1, j));
  const double noise = std::sqrt(2.0 * std::numbers::pi * log.model->reading_variance[j]);
  return passed > noise ? elementary::log(passed / noise) : 0.0;
}

double price_of_friction(const CoarseLog& log, int j, const CoarseExplanation& fit, int from) {
  double power = 0.0;  // that the added friction takes
  for (int k = from; k < log.samples(); ++k) {
    const double v = log.about(log.joints() + j, k);
    power += (fit.size[0] * v + fit.size[1] * elementary::tanh(v / log.model->body.friction_width()[j])) * v;
  }
  return log.samples() - from < 2 || power <= 0.0 ? kNoSuchSize : 0.0;
}

}  // namespace

double coarse_price(const CoarseLog& log, const CoarseGuess& guess, const CoarseExplanation& fit, int from) {
  const int j = guess.joint - 1, late = log.samples() - from;
  switch (guess.kind) {
    case FaultKind::torque_loss:
      return (fit.size[0] < 0.0 ? kNoSuchSize : 0.0) + kBeyondLoss * std::max(0.0, fit.size[0] - kMostLoss);
    case FaultKind::payload_change:
      return fit.size[0] < 0.0 ? kNoSuchSize : 0.0;
    case FaultKind::friction_increase:
      return price_of_friction(log, j, fit, from);
    case FaultKind::stuck_encoder: {
      if (share_repeated(log, j, from) < kStuckShare) return kCodesMove;
      const double kept = log.keep.row(j).tail(late).sum();
      const double evidence = repeats_are_evidence(*log.model, j)
                                  ? std::min(repeats_from(log, j, from), kMostRepeats) *
                                        elementary::log(1.0 / log.model->repeat_share[j])
                                  : 0.0;
      return kStillJoint + kUnreadSample * kept + price_of_new_code(log, j, from) - evidence;
    }
    case FaultKind::locked:
      return kStillJoint + (share_repeated(log, j, from) > kStuckShare && repeats_are_evidence(*log.model, j)
                                ? kRepeatedReading * late
                                : 0.0);
    case FaultKind::unknown:
      return kStillJoint + kForcedRow * late;
    default:
      return 0.0;
  }
}

}  // namespace faultline
