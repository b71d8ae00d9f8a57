// SPDX-License-Identifier: MIT
#include "lib/log/resample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/log/log.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

constexpr double kGapPeriods = 3.0;  // of the longer of both periods: a longer step is a gap

/// Returns the value at `share` of the way from row `left` to the next.
double between(const std::vector<double>& values, int left, double share) {
  const auto at = static_cast<std::size_t>(left);
  return share == 0.0 ? values[at] : values[at] + share * (values[at + 1] - values[at]);
}

class Resampling {
 public:
  explicit Resampling(const ResampleOptions& options) : options_(options) {}

  bool next(LogSource& source, Log& segment) {
    while (!at_end_) {
      at_end_ = !source.next(incoming_);
      if (!at_end_) append(recorded_, incoming_);
      if (recorded_.rows() == 0) continue;
      place_rows();
      make(segment);
      segment.first_row = made_;
      made_ += segment.rows();
      forget_old_rows();
      if (segment.rows() > 0) return true;
    }
    return false;
  }

 private:
  /// A new row: `share` of the way from recorded row `left` to the next one.
  struct NewRow {
    double time = 0.0;
    int left = 0;
    double share = 0.0;
  };

  double next_time() const { return start_ + static_cast<double>(step_) * options_.period_s; }
  double after() const { return (1.0 - options_.torque_phi) * options_.period_s; }
  double before() const { return options_.torque_phi * options_.period_s; }
  bool is_gap(double span) const {
    return usual_ > 0.0 && span > kGapPeriods * std::max(options_.period_s, usual_);
  }

  /// Finds the new rows for which all required recorded rows are present.
  void place_rows() {
    rows_.clear();
    const auto& time = recorded_.time;
    if (step_ < 0) {
      start_ = time.front();
      step_ = 0;
    }
    for (int i = static_cast<int>(gap_.size()); i + 1 < recorded_.rows(); ++i) {
      const double span = time[i + 1] - time[i];
      gap_.push_back(is_gap(span));
      if (!gap_.back()) usual_ = span;
    }
    while (placed_ + 1 < recorded_.rows() && (at_end_ || time[placed_ + 1] + after() <= time.back()))
      place_between(placed_++);
    if (at_end_ && next_time() == time.back())
      rows_.push_back({time.back(), recorded_.rows() - 1, 0.0}), ++step_;
  }

  /// Adds the new rows from a recorded row up to, not including, the next.
  void place_between(int left) {
    const double from = recorded_.time[left], to = recorded_.time[left + 1];
    for (double t = next_time(); t < to; t = next_time()) {
      if (!gap_[left] || t == from) rows_.push_back({t, left, (t - from) / (to - from)});
      const double behind = gap_[left] ? std::ceil((to - start_) / options_.period_s) : 0.0;
      step_ = std::max(step_ + 1, static_cast<std::int64_t>(behind));
    }
  }

  /// Returns the mean over one period around a row, of the steps outside gaps; each step has its mean torque.
  double mean_torque(const std::vector<double>& tau, const NewRow& row) const {
    const auto& time = recorded_.time;
    const double begin = row.time - before(), end = row.time + after(), phi = options_.torque_phi;
    double sum = 0.0, covered = 0.0;
    const auto add_step = [&](int k) {
      const double overlap = std::min(end, time[k + 1]) - std::max(begin, time[k]);
      if (overlap <= 0.0) return;
      sum += overlap * ((1.0 - phi) * tau[k] + phi * tau[k + 1]);
      covered += overlap;
    };
    int first = row.left;
    while (first > 0 && time[first] > begin && !gap_[first - 1]) --first;
    for (int k = first; k + 1 < recorded_.rows() && time[k] < end && !gap_[k]; ++k) add_step(k);
    return covered > 0.0 ? sum / covered : tau[row.left];
  }

  void make(Log& segment) const {
    for_each_column(segment, recorded_, [&](std::vector<double>& to, const std::vector<double>& from) {
      to.resize(rows_.size());
      for (std::size_t k = 0; k < rows_.size(); ++k) to[k] = between(from, rows_[k].left, rows_[k].share);
    });
    for (std::size_t k = 0; k < rows_.size(); ++k) segment.time[k] = rows_[k].time;
    for (const Quantity quantity : kJointQuantities) {
      if (!is_torque(quantity)) continue;
      JointSignals& to = signals_of(segment, quantity);
      for (std::size_t j = 0; j < to.size(); ++j)
        for (std::size_t k = 0; k < rows_.size(); ++k)
          to[j][k] = mean_torque(signals_of(recorded_, quantity)[j], rows_[k]);
    }
  }

  /// Keeps the rows that the next new row may need.
  void forget_old_rows() {
    int first = placed_;
    while (first > 0 && recorded_.time[first] > next_time() - before() - options_.period_s) --first;
    if (first == 0) return;
    recorded_ = slice(recorded_, first, recorded_.rows());
    gap_.erase(gap_.begin(), gap_.begin() + first);
    placed_ -= first;
  }

  ResampleOptions options_;
  Log incoming_;
  Log recorded_;              ///< rows that new ones may still need
  std::vector<bool> gap_;     ///< for each recorded row: whether a gap follows it
  std::vector<NewRow> rows_;  ///< new rows of the present segment
  int placed_ = 0;            ///< recorded rows for which the new rows up to the next one are made
  bool at_end_ = false;
  double start_ = 0.0;
  double usual_ = 0.0;      ///< last recorded step that was no gap
  std::int64_t step_ = -1;  ///< grid index of the next new row; -1 before the first
  std::int64_t made_ = 0;
};

}  // namespace

std::unique_ptr<LogSource> resampled(LogSource& source, const ResampleOptions& options) {
  if (!(options.period_s > 0.0) || !std::isfinite(options.period_s))
    throw Error(ErrorCode::usage, "resampling", "the sample period must be a positive number of seconds");
  return std::make_unique<StagedSource<Resampling>>(source, Resampling(options));
}

}  // namespace faultline
