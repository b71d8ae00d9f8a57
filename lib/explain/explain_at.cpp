// SPDX-License-Identifier: MIT
#include "lib/explain/explain_at.hpp"

#include <algorithm>

#include "lib/explain/coarse/coarse_bench.hpp"
#include "lib/explain/coarse/fault_directions.hpp"
#include "lib/explain/refine.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

/// Times of a fault. A collision always has an end; a stuck encoder and a sensor bias begin with a sample.
struct FaultTimes {
  double onset_s = 0.0, end_s = kNeverEnds;
  double sample_s = 0.0;  ///< first sample from the onset on
};

FaultTimes times_of(const UniformLog& log, double onset_s, double end_s) {
  const double row = (onset_s - log.start_s) / log.period_s;
  return {onset_s, end_s, log.time_s(std::clamp(std::ceil(row - 1e-6), 0.0, log.rows() - 1.0))};
}

/// Returns the jump of a joint's position next to a time, as an initial size; 0 if there is none.
double jump_near(const LogFit& fit, Joint joint, double time_s) {
  double size = 0.0, nearest = 4.0 * fit.log().period_s;
  for (const SensorJump& jump : sensor_jumps(fit, joint.index()))
    if (std::abs(jump.onset_s - time_s) < nearest)
      nearest = std::abs(jump.onset_s - time_s), size = jump.size;
  return size;
}

/// Judges every kind and joint at the times of a fault.
LogExplanation judged_at(const LogFit& fit, const FaultTimes& at) {
  JudgedHypotheses bench{fit};
  for (const LinearFault& fault : fit.linear())
    bench.go({fault.kind, fault.joint, at.onset_s, at.end_s, {}, fault.columns.grow});
  bench.go({FaultKind::collision, fit.last_joint(), at.onset_s,
            at.end_s - at.onset_s < kLongestBlow_s ? at.end_s : kNeverEnds});
  for (int j = 0; j < fit.joints(); ++j) {
    const Joint joint = Joint::at(j);
    bench.go({FaultKind::locked, joint, at.onset_s, at.end_s});
    bench.go({FaultKind::stuck_encoder, joint, at.sample_s, at.end_s});
    bench.go({FaultKind::sensor_drift, joint, at.onset_s, at.end_s});
    const double jump = jump_near(fit, joint, at.sample_s);
    bench.go({FaultKind::sensor_bias, joint, at.sample_s, at.end_s, Eigen::VectorXd::Constant(1, jump)});
  }
  LogExplanation e;
  e.best = best_of_each(bench.judged);
  e.healthy_square = fit.healthy().mean_square();
  e.free_form = free_form(fit);
  return with_evidence(fit, std::move(e));
}

/// Judges them likewise at a coarse rate.
LogExplanation judged_at(const CoarseLog& log, const FaultTimes& at) {
  CoarseBench bench(log);
  const double lasts_s = at.end_s < kNeverEnds ? at.end_s - at.onset_s : 0.0;
  for (const FaultLabel& label : fault_labels_of(*log.model)) {
    if (label.kind == FaultKind::free_swinging) continue;
    const bool begins_with_sample =
        label.kind == FaultKind::stuck_encoder || label.kind == FaultKind::sensor_bias;
    const bool passes = label.kind == FaultKind::collision;
    bench.go({label.kind, label.joint, begins_with_sample ? at.sample_s : at.onset_s,
              passes && lasts_s == 0.0 ? kLongestBlow_s : lasts_s},
             1);
  }
  bench.integrate_best();
  return bench.explanation();
}

}  // namespace

std::optional<ExplainedFault> explain_at(const UniformLog& log, const ExplainModel& model, double onset_s,
                                         double end_s) {
  LogExplanation e;
  if (const auto* steps = std::get_if<OneStepModel>(&model.robot)) {
    const std::optional<CoarseLog> followed = followed_log(log, *steps);
    if (followed) e = judged_at(*followed, times_of(log, onset_s, end_s));
  } else {
    const UniformLog means = averaged_as(log, model.robot);
    e = explain_with_own_noise(means, std::get<BalanceModel>(model.robot), {}, [&](const LogFit& fit) {
          return judged_at(fit, times_of(means, onset_s, end_s));
        }).explanation;
  }
  std::vector<ExplainedFault> named = named_faults(e, model.limits, 1);
  if (named.empty()) return std::nullopt;
  return std::move(named.front());
}

}  // namespace faultline
