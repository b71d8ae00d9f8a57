// SPDX-License-Identifier: MIT
#include "lib/explain/explain_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/explain/coarse/explain_coarse.hpp"
#include "lib/explain/explain_faults.hpp"

namespace faultline {
namespace {

constexpr double kShortest_s =
    1.5;                           // from 50 Hz on: the lead in which no onset is looked for, and some moves
constexpr int kFewestCoarse = 20;  // samples

/// One fault at most.
ExplainedLog explain_at_coarse_rate(const UniformLog& log, const OneStepModel& model,
                                    const EvidenceLimits& limits) {
  const std::optional<CoarseLog> followed = followed_log(log, model);
  if (!followed) return {};
  const CoarseLog& read = *followed;
  const LogExplanation e = explain_coarse(read);
  ExplainedLog out;
  if (std::optional<ExplainedFault> fault = decide_log(e, limits, coarse_evidence(read, e)))
    out.faults.push_back(std::move(*fault));
  return out;
}

}  // namespace

double sample_period_s(const RobotRows& robot) {
  return std::visit([](const auto& model) { return model.setting.period_s; }, robot);
}

bool can_explain(const UniformLog& log, const RobotRows& robot) {
  if (std::holds_alternative<OneStepModel>(robot)) return log.rows() >= kFewestCoarse;
  return log.rows() * log.period_s >= kShortest_s;
}

ExplainedLog explain_whole_log(const UniformLog& log, const ExplainModel& model) {
  if (const auto* coarse = std::get_if<OneStepModel>(&model.robot))
    return explain_at_coarse_rate(log, *coarse, model.limits);
  return explain_faults(log, std::get<BalanceModel>(model.robot), model.limits);
}

LogExplanation explain_healthy(const UniformLog& log, const RobotRows& robot) {
  if (const auto* coarse = std::get_if<OneStepModel>(&robot)) return explain_coarse(coarse_log(log, *coarse));
  return explain_log({log, std::get<BalanceModel>(robot)});
}

}  // namespace faultline
