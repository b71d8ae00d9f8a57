// SPDX-License-Identifier: MIT
#include "lib/log/time_axis.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "lib/core/json_values.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kGapFactor = 3.0;    // a step longer than so many periods is a gap
constexpr double kJitterShare = 0.2;  // a step that differs by more than this share of a period is uneven
constexpr double kRounding = 1e-6;    // relative to the length of a gap

}  // namespace

double median_step(std::span<const double> time) {
  if (time.size() < 2) return std::nan("");
  std::vector<double> steps(time.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = time[i + 1] - time[i];
  return upper_median_of(steps);
}

void TimeAxisPass::add(const std::vector<double>& time) {
  for (const double t : time) {
    if (axis_.rows++ == 0) axis_.start_s = t;
    if (!std::isnan(axis_.period_s)) {
      judge_step(axis_.end_s, t);
    } else {
      head_.push_back(t);
      if (head_.size() > kPeriodSteps) settle_period();
    }
    axis_.end_s = t;
  }
}

void TimeAxisPass::settle_period() {
  axis_.period_s = median_step(head_);
  for (std::size_t i = 1; i < head_.size(); ++i) judge_step(head_[i - 1], head_[i]);
  head_ = {};
}

void TimeAxisPass::judge_step(double before, double now) {
  ++judged_;
  const double step = now - before;
  if (step > kGapFactor * axis_.period_s) {
    ++axis_.gaps;
    if (axis_.listed_gaps.size() < kListedGaps) axis_.listed_gaps.push_back({judged_, before, step});
    axis_.longest_gap_s = std::max(axis_.longest_gap_s, step);
    axis_.in_gaps_s += step;
    return;
  }
  const double off = step - axis_.period_s;
  axis_.uneven_steps += std::abs(off) > kJitterShare * axis_.period_s;
  axis_.largest_jitter_s = std::max(axis_.largest_jitter_s, std::abs(off));
  squares_ += off * off;
}

TimeAxis without_run_breaks(TimeAxis axis, const std::vector<LogRun>& runs) {
  const auto is_break = [&](const TimeGap& gap) {
    return std::any_of(runs.begin(), runs.end(), [&](const LogRun& run) {
      return run.run > 1 && run.is_read && run.start_s > gap.start_s &&
             run.start_s < gap.start_s + (1.0 + kRounding) * gap.length_s;
    });
  };
  std::vector<TimeGap> kept;
  axis.longest_gap_s = axis.gaps > std::ssize(axis.listed_gaps) ? axis.longest_gap_s : 0.0;
  for (const TimeGap& gap : axis.listed_gaps) {
    if (is_break(gap)) {
      --axis.gaps;
      axis.in_gaps_s -= gap.length_s;
      continue;
    }
    axis.longest_gap_s = std::max(axis.longest_gap_s, gap.length_s);
    kept.push_back(gap);
  }
  axis.listed_gaps = std::move(kept);
  return axis;
}

TimeAxis TimeAxisPass::result() const {
  TimeAxisPass done = *this;
  if (std::isnan(done.axis_.period_s) && done.head_.size() > 1) done.settle_period();
  const std::int64_t steps = done.judged_ - done.axis_.gaps;
  if (steps > 0) done.axis_.jitter_s = std::sqrt(done.squares_ / static_cast<double>(steps));
  return done.axis_;
}

nlohmann::ordered_json log_run_json(const LogRun& run) {
  return {{"run", run.run},
          {"first_row", run.first_row},
          {"rows", run.rows},
          {"start_s", number_or_null(run.start_s)},
          {"end_s", number_or_null(run.end_s)},
          {"clock_offset_s", number_or_null(run.clock_offset_s)},
          {"read", run.is_read}};
}

}  // namespace faultline
