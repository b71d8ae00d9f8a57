// SPDX-License-Identifier: MIT
#include "lib/explain/explain_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/coarse/coarse_bench.hpp"
#include "lib/explain/coarse/coarse_search.hpp"
#include "lib/explain/coarse/explain_coarse.hpp"
#include "lib/explain/explain_faults.hpp"

namespace faultline {
namespace {

constexpr double kShortest_s = 1.5;  // of a log from 50 Hz on: the lead without onsets, and some moves
constexpr int kFewestCoarse = 20;    // samples of a log below 50 Hz
constexpr int kAtTheStart = 2;       // samples behind the earliest onset: a fault that begins with the log

/// By joint: standard deviations that the healthy robot leaves of the log's readings.
std::vector<double> loudness_of(const CoarseLog& log) {
  const int n = log.joints();
  std::vector<double> out;
  for (int j = 0; j < n; ++j)
    out.push_back(
        std::sqrt((log.healthy.left.row(j).squaredNorm() + log.healthy.left.row(n + j).squaredNorm()) /
                  (2.0 * log.samples())));
  return out;
}

/// An unknown fault begins where the healthy robot ceases to explain the log.
ExplainedFault with_first_strike(ExplainedFault fault, const CoarseLog& log) {
  const std::optional<int> strike = first_strike(log);
  if (!strike || log.time_s(*strike) >= fault.claim.onset_s) return fault;
  fault.claim.onset_s = log.time_s(std::max(log.first_onset(), *strike - 1));
  fault.alarm_s = std::min(fault.alarm_s, log.time_s(*strike));
  return fault;
}

/// Whether what explains a log best leaves more than noise, where smoothing did not converge: a robot that
/// runs away is far from linear in its torques, and no hypothesis is judged rightly there.
bool runs_away(const CoarseLog& log, const LogExplanation& e) {
  return log.settled < log.samples() && !e.best.empty() && e.best.front().fit.mean_square() > kMuchLeft;
}

/// At most one fault. An unknown fault that begins with the log is not reported: the model may not fit the
/// log from its first row on, and the loudness of the log says so.
ExplainedLog explained_coarse(const CoarseLog& log, const EvidenceLimits& limits) {
  const LogExplanation e = explain_coarse(log);
  if (runs_away(log, e))
    if (const std::optional<CoarseLog> before = settled_part(log))
      if (ExplainedLog out = explained_coarse(*before, limits); !out.faults.empty()) return out;
  std::optional<ExplainedFault> fault = decide_log(e, limits, coarse_evidence(log, e));
  ExplainedLog out;
  out.judged_s =
      log.period_s() * static_cast<double>(std::count(log.log.lost.begin(), log.log.lost.end(), false));
  if (!fault) return out;
  if (fault->claim.kind == FaultKind::unknown) {
    fault = with_first_strike(std::move(*fault), log);
    if (fault->claim.onset_s <= log.time_s(log.first_onset() + kAtTheStart)) {
      out.loudness = loudness_of(log);
      return out;
    }
  }
  out.faults.push_back(std::move(*fault));
  return out;
}

/// While a fault lasts nothing else is looked for.
ExplainedLog explain_at_coarse_rate(UniformLog log, const OneStepModel& model, const EvidenceLimits& limits,
                                    std::vector<FaultClaim> lasting) {
  double decided_s = log.start_s;
  for (FaultClaim& claim : lasting) {
    if (claim.end_s >= kNeverEnds)
      if (const std::optional<CoarseLog> followed = followed_log(log, model))
        claim = followed_coarse(*followed, std::move(claim), limits.of(claim.kind));
    decided_s = std::max(decided_s, claim.end_s);
  }
  ExplainedLog out;
  const double first = std::ceil((decided_s - log.start_s) / log.period_s);
  if (first + kFewestCoarse <= log.rows()) {
    if (first > 0.0) log = rows_from(log, static_cast<int>(first));
    if (const std::optional<CoarseLog> rest = followed_log(std::move(log), model))
      out = explained_coarse(*rest, limits);
  }
  out.followed = std::move(lasting);
  return out;
}

}  // namespace

UniformLog averaged_as(const UniformLog& log, const RobotRows& robot) {
  const auto* model = std::get_if<BalanceModel>(&robot);
  return model == nullptr ? log : averaged(log, model->setting.averaged, model->setting.torque_is_held);
}

bool can_explain(const UniformLog& log, const RobotRows& robot) {
  if (std::holds_alternative<OneStepModel>(robot)) return log.rows() >= kFewestCoarse;
  return log.rows() * log.period_s >= kShortest_s;
}

ExplainedLog explain_whole_log(const UniformLog& log, const ExplainModel& model,
                               const std::vector<FaultClaim>& lasting) {
  if (const auto* coarse = std::get_if<OneStepModel>(&model.robot))
    return explain_at_coarse_rate(log, *coarse, model.limits, lasting);
  return explain_faults(averaged_as(log, model.robot), std::get<BalanceModel>(model.robot), model.limits,
                        lasting);
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

}  // namespace faultline
