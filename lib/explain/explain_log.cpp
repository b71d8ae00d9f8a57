// SPDX-License-Identifier: MIT
#include "lib/explain/explain_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/coarse/coarse_bench.hpp"
#include "lib/explain/coarse/coarse_search.hpp"
#include "lib/explain/coarse/explain_coarse.hpp"
#include "lib/explain/coarse/fault_directions.hpp"
#include "lib/explain/explain_faults.hpp"
#include "lib/explain/refine.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

constexpr double kShortest_s = 1.5;  // of a log of 50 Hz and more: the lead without onsets, and some motion
constexpr int kFewestCoarse = 20;    // samples of a log below 50 Hz
constexpr int kAtTheStart = 2;       // samples after the earliest onset: a fault that begins with the log

/// Returns by joint the root mean square of the whitened residuals of the healthy robot.
std::vector<double> noise_levels(const CoarseLog& log) {
  const int n = log.joints();
  const Eigen::MatrixXd left =
      Eigen::Map<const Eigen::MatrixXd>(log.healthy.left.data(), 2 * n, log.samples());
  std::vector<double> out;
  for (int j = 0; j < n; ++j)
    out.push_back(
        std::sqrt((left.row(j).squaredNorm() + left.row(n + j).squaredNorm()) / (2.0 * log.samples())));
  return out;
}

/// Moves the onset of an unknown fault to where the healthy robot ceases to explain the log, if earlier.
ExplainedFault with_first_strike(ExplainedFault fault, const CoarseLog& log) {
  const std::optional<int> strike = first_strike(log);
  if (!strike || log.time_s(*strike) >= fault.claim.onset_s) return fault;
  fault.claim.onset_s = log.time_s(std::max(log.first_onset(), *strike - 1));
  fault.alarm_s = std::min(fault.alarm_s, log.time_s(*strike));
  return fault;
}

/// Returns whether the best explanation has larger residuals than noise and smoothing does not converge: a
/// robot that runs away is far from linear in its torques, so that hypotheses are misjudged there.
bool is_divergent(const CoarseLog& log, const LogExplanation& e) {
  return log.settled < log.samples() && !e.best.empty() && e.best.front().fit.mean_square() > kLargeResidual;
}

/// Explains a log by one fault at most. An unknown fault that begins with the log is not reported: the model
/// may not fit the log from its first row on, which the noise level of the log shows.
ExplainedLog explained_coarse(const CoarseLog& log, const EvidenceLimits& limits) {
  const LogExplanation e = explain_coarse(log);
  if (is_divergent(log, e))
    if (const std::optional<CoarseLog> before = settled_part(log))
      if (ExplainedLog out = explained_coarse(*before, limits); !out.faults.empty()) return out;
  std::optional<ExplainedFault> fault = decide_log(e, limits);
  ExplainedLog out{.score = score_of(e, limits)};
  out.judged_s =
      log.period_s() * static_cast<double>(std::count(log.log.lost.begin(), log.log.lost.end(), false));
  if (!fault) return out;
  if (fault->claim.kind == FaultKind::unknown) {
    fault = with_first_strike(std::move(*fault), log);
    if (fault->claim.onset_s <= log.time_s(log.first_onset() + kAtTheStart)) {
      out.loudness = noise_levels(log);
      return out;
    }
  }
  out.faults.push_back(std::move(*fault));
  return out;
}

/// Samples of a log from `begin` to before `end`.
struct Part {
  int begin = 0, end = 0;
};

/// Returns the parts of a log without a known fault.
std::vector<Part> parts_beside(const UniformLog& log, const std::vector<FaultClaim>& known) {
  const auto row = [&](double time_s) {
    return static_cast<int>(
        std::ceil(std::clamp((time_s - log.start_s) / log.period_s, 0.0, 1.0 * log.rows())));
  };
  std::vector<Part> busy;
  for (const FaultClaim& claim : known) busy.push_back({row(claim.onset_s), row(claim.end_s)});
  std::ranges::sort(busy, {}, &Part::begin);
  std::vector<Part> out;
  int begin = 0;
  for (const Part& part : busy) {
    if (part.begin > begin) out.push_back({begin, part.begin});
    begin = std::max(begin, part.end);
  }
  if (begin < log.rows()) out.push_back({begin, log.rows()});
  return out;
}

/// Explains a log at a coarse rate. Searches no other fault while one lasts.
ExplainedLog explain_at_coarse_rate(const UniformLog& log, const OneStepModel& model,
                                    const EvidenceLimits& limits, std::vector<FaultClaim> lasting,
                                    const SignalStretches& signals) {
  for (FaultClaim& claim : lasting)
    if (claim.end_s >= kNeverEnds)
      if (const std::optional<CoarseLog> followed = followed_log(log, model))
        claim = followed_coarse(*followed, std::move(claim), limits.of(claim.kind));
  const std::vector<JudgedStretch> stretches = judged_stretches(signals.begin, {}, signals.known, nullptr);
  std::vector<FaultClaim> known = signals.known;
  for (const FaultClaim& claim : lasting)
    known.push_back({claim.kind, claim.joint, log.start_s, claim.end_s});
  for (const JudgedStretch& judged : stretches) known.push_back(judged.fault.claim);
  ExplainedLog out;
  for (const Part& part : parts_beside(log, known)) {
    if (part.end - part.begin < kFewestCoarse || !out.faults.empty()) continue;
    const std::optional<CoarseLog> alone =
        followed_log(part_of(log, part.begin, part.end - part.begin), model);
    if (!alone) continue;
    ExplainedLog explained = explained_coarse(*alone, limits);
    out.faults = std::move(explained.faults);
    out.loudness = std::move(explained.loudness);
    out.score = larger(out.score, explained.score);
    out.judged_s += explained.judged_s;
  }
  out.stretches = judged_stretches(signals.begin, out.faults, signals.known, nullptr);
  out.followed = std::move(lasting);
  return out;
}

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

UniformLog averaged_as(const UniformLog& log, const RobotRows& robot) {
  const auto* model = std::get_if<BalanceModel>(&robot);
  return model == nullptr ? log : averaged(log, model->setting.averaged, model->setting.torque_is_held);
}

bool can_explain(const UniformLog& log, const RobotRows& robot) {
  if (std::holds_alternative<OneStepModel>(robot)) return log.rows() >= kFewestCoarse;
  const RowSetting& setting = std::get<BalanceModel>(robot).setting;
  const int rows =
      log.rows() / std::max(1, setting.averaged);  // a short part of a log may show another period
  return std::min(log.rows() * log.period_s, rows * setting.period_s) >= kShortest_s;
}

ExplainedLog explain_whole_log(const UniformLog& log, const ExplainModel& model,
                               const std::vector<FaultClaim>& lasting, const SignalStretches& signals) {
  if (const auto* coarse = std::get_if<OneStepModel>(&model.robot))
    return explain_at_coarse_rate(log, *coarse, model.limits, lasting, signals);
  return explain_faults(averaged_as(log, model.robot), std::get<BalanceModel>(model.robot), model.limits,
                        lasting, signals);
}

LogExplanation explain_healthy(const UniformLog& log, const RobotRows& robot) {
  if (const auto* coarse = std::get_if<OneStepModel>(&robot)) {
    const std::optional<CoarseLog> followed = followed_log(log, *coarse);
    return followed ? explain_coarse(*followed) : LogExplanation{};
  }
  return explain_with_own_noise(averaged_as(log, robot), std::get<BalanceModel>(robot), {},
                                [](const LogFit& fit) { return explain_log(fit); })
      .explanation;
}

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
