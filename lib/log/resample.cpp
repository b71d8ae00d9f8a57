// SPDX-License-Identifier: MIT
#include "lib/log/resample.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/log/log_channels.hpp"

namespace faultline {
namespace {

/// A new row: `share` of the way from recorded row `left` to the one after it.
struct NewRow {
  double time = 0.0;
  int left = 0;
  double share = 0.0;
};

class ResampledSource : public LogSource {
 public:
  ResampledSource(std::unique_ptr<LogSource> source, const ResampleOptions& options)
      : source_(std::move(source)), options_(options) {
    if (!(options.period_s > 0.0) || !std::isfinite(options.period_s))
      throw Error(ErrorCode::usage, "resampling", "the sample period must be a positive number of seconds");
  }

  bool next(Log& segment) override {
    while (source_->next(incoming_)) {
      append(recorded_, incoming_);
      place_rows();
      make(segment);
      const int last = recorded_.rows() - 1;
      recorded_ = slice(recorded_, last, last + 1);
      if (segment.rows() > 0) return true;
    }
    return false;
  }

  void rewind() override {
    source_->rewind();
    recorded_ = {};
    made_ = 0;
    step_ = -1;
  }
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return source_->share_read(); }

 private:
  double grid_time() const { return start_ + static_cast<double>(step_) * options_.period_s; }
  bool is_gap(double step, double usual) const {
    return step >
           (options_.longest_gap_s > 0.0 ? options_.longest_gap_s : 3.0 * std::max(options_.period_s, usual));
  }

  /// Finds the new rows that lie within the recorded ones.
  void place_rows() {
    rows_.clear();
    const auto& time = recorded_.time;
    if (step_ < 0) {
      start_ = time.front();
      step_ = 0;
      usual_ = 0.0;
      rows_.push_back({start_, 0, 0.0});
      ++step_;
    }
    for (int i = 0; i + 1 < recorded_.rows(); ++i) {
      const double span = time[i + 1] - time[i];
      const bool gap = usual_ > 0.0 && is_gap(span, usual_);
      for (double t = grid_time(); t <= time[i + 1]; t = grid_time()) {
        if (t == time[i + 1])
          rows_.push_back({t, i + 1, 0.0});
        else if (!gap)
          rows_.push_back({t, i, (t - time[i]) / span});
        if (gap && t < time[i + 1])
          step_ = std::max(step_ + 1,
                           static_cast<std::int64_t>(std::ceil((time[i + 1] - start_) / options_.period_s)));
        else
          ++step_;
      }
      if (!gap) usual_ = span;
    }
  }

  void make(Log& segment) {
    for_each_column(segment, recorded_, [&](std::vector<double>& to, const std::vector<double>& from) {
      to.resize(rows_.size());
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        const NewRow& row = rows_[k];
        to[k] = row.share == 0.0 ? from[row.left]
                                 : from[row.left] + row.share * (from[row.left + 1] - from[row.left]);
      }
    });
    for (std::size_t k = 0; k < rows_.size(); ++k) segment.time[k] = rows_[k].time;
    segment.first_row = made_;
    made_ += static_cast<std::int64_t>(rows_.size());
  }

  std::unique_ptr<LogSource> source_;
  ResampleOptions options_;
  Log incoming_;
  Log recorded_;  ///< the last row of before, then the present segment
  std::vector<NewRow> rows_;
  double start_ = 0.0;
  double usual_ = 0.0;      ///< last recorded step that was no gap
  std::int64_t step_ = -1;  ///< of the next new row on the grid; -1 before the first
  std::int64_t made_ = 0;
};

}  // namespace

std::unique_ptr<LogSource> resampled(std::unique_ptr<LogSource> source, const ResampleOptions& options) {
  return std::make_unique<ResampledSource>(std::move(source), options);
}

}  // namespace faultline
