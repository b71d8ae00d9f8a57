// SPDX-License-Identifier: MIT
#include "apps/work/comparison.hpp"

#include <fmt/format.h>

#include <utility>

#include "lib/core/error.hpp"
#include "lib/diagnose/monitor/model_rate.hpp"

namespace faultline {

ReadRun read_run(LogSource& log, const Model* model) {
  const std::string path = log.identity().path;
  if (!model) return {run_signals(path, read_all(log), nullptr), {}};
  const LogRate rate = log_rate(log, *model);
  if (rate.is_models()) return {run_signals(path, read_all(log), &model->residual), {}};
  if (!rate.can_be_resampled())
    throw Error(ErrorCode::input, path,
                fmt::format("has a sample every {:.4g} s, but the model was learned from logs with one "
                            "every {:.4g} s; compare without a model",
                            rate.period_s, model->sample_period_s));
  return {run_signals(path, read_all(*at_model_rate(log, *model)), &model->residual),
          path + ": " + resampled_issue(rate, *model).message};
}

std::vector<char> turns_of(const Model& model) {
  std::vector<char> turns;
  for (const JointGeometry& joint : model.robot.chain.geometry)
    turns.push_back(joint.kind == AxisKind::revolute);
  return turns;
}

ComparedLogs compare_logs(LogSource& first, LogSource& second, const Model* model, AlignmentKind align) {
  ReadRun a = read_run(first, model), b = read_run(second, model);
  ComparedLogs out{compare_runs(std::move(a.signals), std::move(b.signals), align),
                   model ? turns_of(*model) : std::vector<char>{}};
  for (const auto& note : {a.note, b.note})
    if (note) out.comparison.notes.push_back(*note);
  return out;
}

}  // namespace faultline
