// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/model_rate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/resample.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr double kSameRate = 0.02;  // relative; clocks of two recorders differ by far less
/// Longest period that can be resampled, times the model's. Interpolated rows have less noise than the model
/// expects, correlated between neighbours: harmless while most new rows have a recorded row of their own.
constexpr double kMostStretch = 1.3;
constexpr double kGapSteps = 3.0;  // a step of so many periods is a gap

/// Mean step without gaps, s: if stamps are rounded to whole ms, the median step is not the period.
double mean_step(const std::vector<double>& time, double usual) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double step = time[i] - time[i - 1];
    if (step < kGapSteps * usual) sum += step, count += 1.0;
  }
  return count > 0.0 ? sum / count : usual;
}

std::vector<double> first_times(LogSource& log) {
  std::vector<double> time;
  log.rewind();
  for (Log segment; time.size() <= kPeriodSteps && log.next(segment);)
    time.insert(time.end(), segment.time.begin(), segment.time.end());
  log.rewind();
  if (time.size() > kPeriodSteps + 1) time.resize(kPeriodSteps + 1);
  return time;
}

}  // namespace

bool LogRate::can_be_resampled() const { return ratio <= kMostStretch; }

LogRate log_rate(LogSource& log, const Model& model) {
  const std::vector<double> time = first_times(log);
  if (time.size() < 2 || !(model.sample_period_s > 0.0)) return {};
  const double usual = median_step(time), mean = mean_step(time, usual);
  const auto is_models = [&](double period) {
    return std::abs(period / model.sample_period_s - 1.0) <= kSameRate;
  };
  return {usual, is_models(usual) || is_models(mean) ? 1.0 : usual / model.sample_period_s};
}

Issue resampled_issue(const LogRate& rate, const Model& model) {
  return make_issue(kResampled, Severity::warning,
                    fmt::format("the log has a sample every {:.4g} s, the model was learned from logs with "
                                "one every {:.4g} s; it was resampled to the rate of the model",
                                rate.period_s, model.sample_period_s));
}

std::unique_ptr<LogSource> at_model_rate(LogSource& log, const Model& model) {
  return resampled(log, {.period_s = model.sample_period_s,
                         .torque_phi = model.has_mechanics() ? model.robot.torque_phi.value_or(0.0) : 0.0});
}

LogSource& judged_rows(LogSource& log, const Model& model, const Issues& issues,
                       std::unique_ptr<LogSource>& kept) {
  log.rewind();
  if (!issues.find(kResampled)) return log;
  kept = at_model_rate(log, model);
  return *kept;
}

}  // namespace faultline
