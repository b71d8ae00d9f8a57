// SPDX-License-Identifier: MIT
#include "lib/identify/stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/smooth.hpp"

namespace faultline {
namespace {

constexpr int kSmallestStretch = 4;
constexpr double kOutlier = 20.0;  ///< times the distance that nine samples in ten keep

/// A sample far from the middle of its neighbours while these agree with each other.
void mark_outliers(const Eigen::RowVectorXd& y, int row, Eigen::MatrixXi& out) {
  const int n = static_cast<int>(y.size());
  std::vector<double> bends;
  for (int k = 1; k + 1 < n; ++k) bends.push_back(std::abs(y[k] - 0.5 * (y[k - 1] + y[k + 1])));
  const double usual = std::max(upper_quantile(bends, 0.9), 1e-9 * (1.0 + y.cwiseAbs().mean()));
  for (int k = 1; k + 1 < n; ++k)
    if (bends[k - 1] > kOutlier * usual && bends[k - 1] > 2.0 * std::abs(y[k + 1] - y[k - 1]))
      out(row, k) = 1;
}

/// Gathers rows and cuts them into stretches.
class StretchCutter {
 public:
  StretchCutter(int log, int joints, const std::function<void(const Stretch&)>& visit)
      : log_(log), joints_(joints), visit_(visit) {}

  void add(const Log& segment) {
    for (int k = 0; k < segment.rows(); ++k) add_row(segment, k);
  }
  StretchSummary finish() {
    flush();
    return {rows_, period_};
  }

 private:
  bool usable(const Log& s, int k) const {
    bool finite = true;
    for (int j = 0; j < joints_; ++j)
      finite = finite && std::abs(s.q[j][k]) < 1e9 && std::abs(s.tau[j][k]) < 1e9 &&
               (s.dq.empty() || std::abs(s.dq[j][k]) < 1e9);
    return finite;
  }

  void add_row(const Log& s, int k) {
    ++rows_;
    const double t = s.time[k];
    has_dq_ = !s.dq.empty();
    if (!usable(s, k)) return flush();
    if (!time_.empty() && period_ > 0.0) {
      const double step = t - time_.back();
      if (step > 1.6 * period_)
        flush();
      else if (step < 0.4 * period_)
        return;
    }
    time_.push_back(t);
    for (int j = 0; j < joints_; ++j) {
      values_.push_back(s.q[j][k]);
      values_.push_back(has_dq_ ? s.dq[j][k] : 0.0);
      values_.push_back(s.tau[j][k]);
    }
    if (static_cast<int>(time_.size()) >= kStretchRows) flush();
  }

  /// The first rows of a log tell its period; a gap among them cuts nothing.
  void measure_period() {
    std::vector<double> steps;
    for (std::size_t k = 1; k < time_.size(); ++k) steps.push_back(time_[k] - time_[k - 1]);
    if (steps.size() >= 3) period_ = upper_median_of(steps);
  }

  void flush() {
    if (period_ == 0.0) measure_period();
    if (static_cast<int>(time_.size()) >= kSmallestStretch && period_ > 0.0) visit_pieces();
    time_.clear();
    values_.clear();
  }

  /// Rows up to a gap that was not known as one while the period was not.
  void visit_pieces() {
    int begin = 0;
    const int n = static_cast<int>(time_.size());
    for (int k = 1; k <= n; ++k)
      if (k == n || time_[k] - time_[k - 1] > 1.6 * period_) {
        if (k - begin >= kSmallestStretch) visit_piece(begin, k);
        begin = k;
      }
  }

  void visit_piece(int begin, int end) {
    Stretch s;
    s.log = log_;
    s.period_s = period_;
    s.has_dq = has_dq_;
    const int n = end - begin;
    s.time = Eigen::Map<const Eigen::VectorXd>(time_.data() + begin, n);
    for (auto* m : {&s.q, &s.dq, &s.tau}) m->resize(joints_, n);
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < joints_; ++j) {
        const double* v = values_.data() + 3 * (static_cast<std::ptrdiff_t>(begin + k) * joints_ + j);
        s.q(j, k) = v[0];
        s.dq(j, k) = v[1];
        s.tau(j, k) = v[2];
      }
    s.outlier.setZero(2 * joints_, n);
    for (int j = 0; j < joints_; ++j) {
      mark_outliers(s.q.row(j), j, s.outlier);
      if (has_dq_) mark_outliers(s.dq.row(j), joints_ + j, s.outlier);
    }
    smooth(s);
    visit_(s);
  }

  int log_, joints_;
  const std::function<void(const Stretch&)>& visit_;
  bool has_dq_ = false;
  double period_ = 0.0;
  std::int64_t rows_ = 0;
  std::vector<double> time_, values_;
};

void check_channels(const LogSource& source, const Log& segment, int joints) {
  const auto fail = [&](const std::string& message) {
    throw Error(ErrorCode::input, source.identity().path, message);
  };
  if (segment.joints() != joints)
    fail(fmt::format("has {} joints, the robot {}; give the logs of this robot", segment.joints(), joints));
  if (static_cast<int>(segment.tau.size()) != joints)
    fail(
        "has no torque of every joint; identification needs tau1.. or [log.columns] that say which columns "
        "they are");
}

}  // namespace

StretchSummary for_each_stretch(LogSource& source, int log, int joints,
                                const std::function<void(const Stretch&)>& visit) {
  source.rewind();
  StretchCutter cutter(log, joints, visit);
  Log segment;
  while (source.next(segment)) {
    check_channels(source, segment, joints);
    cutter.add(segment);
  }
  return cutter.finish();
}

}  // namespace faultline
