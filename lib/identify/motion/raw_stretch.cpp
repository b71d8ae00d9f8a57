// SPDX-License-Identifier: MIT
#include "lib/identify/motion/raw_stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr int kSmallestStretch = 4;  // rows: fewer give neither a period nor third differences for the noise
constexpr double kGap = 1.6;         // periods: a longer step has lost rows
constexpr double kBridged = 5.5;     // periods: up to here, and
constexpr double kBridged_s = 0.05;  // s, lost rows are restored without a measurement; longer steps cut
constexpr double kTooSoon = 0.4;     // periods: a row that comes earlier is excluded
constexpr double kAbsurd = 1e9;      // rad, m, N m: no joint has such values

/// Gathers rows and cuts them into stretches.
class StretchCutter {
 public:
  StretchCutter(int joints, RepeatedRows repeated, const std::function<void(const RawStretch&)>& visit)
      : joints_(joints), repeated_(repeated), visit_(visit) {}

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
      finite = finite && std::abs(s.q[j][k]) < kAbsurd && std::abs(s.tau[j][k]) < kAbsurd &&
               (s.dq.empty() || std::abs(s.dq[j][k]) < kAbsurd);
    return finite;
  }

  /// Whether the row holds a value; false for a row inserted in place of a lost one.
  bool holds_values(const Log& s, int k) const {
    bool any = false;
    for (int j = 0; j < joints_; ++j) any = any || !std::isnan(s.q[j][k]) || !std::isnan(s.tau[j][k]);
    return any;
  }

  /// Whether row k has the same values as the last accepted row.
  bool repeats(const Log& s, int k) const {
    if (repeated_ == RepeatedRows::none || time_.empty()) return false;
    const double* last = values_.data() + values_.size() - 3 * static_cast<std::size_t>(joints_);
    for (int j = 0; j < joints_; ++j, last += 3)
      if (s.q[j][k] != last[0] || s.tau[j][k] != last[2] || (has_dq_ && s.dq[j][k] != last[1])) return false;
    return true;
  }

  void add_row(const Log& s, int k) {
    rows_ += holds_values(s, k);
    has_dq_ = !s.dq.empty();
    if (!usable(s, k)) return;
    const bool repeated = repeats(s, k);
    if (repeated && repeated_ == RepeatedRows::extra) {
      skipped_s_ += s.time[k] - last_time_;
      last_time_ = s.time[k];
      return;
    }
    last_time_ = s.time[k];
    time_.push_back(s.time[k] - skipped_s_);
    stale_.push_back(repeated ? 1 : 0);
    for (int j = 0; j < joints_; ++j) {
      values_.push_back(s.q[j][k]);
      values_.push_back(has_dq_ ? s.dq[j][k] : 0.0);
      values_.push_back(s.tau[j][k]);
    }
    if (static_cast<int>(time_.size()) >= kStretchRows) flush();
  }

  void flush() {
    const bool enough = static_cast<int>(time_.size()) >= kSmallestStretch;
    if (enough && period_ == 0.0) period_ = median_step(time_);  // of the first rows of the log
    if (enough && period_ > 0.0) visit_pieces();
    time_.clear();
    stale_.clear();
    values_.clear();
  }

  /// Visits the pieces between gaps that are too long to bridge, without rows that come too soon.
  void visit_pieces() {
    std::vector<int> piece;
    for (int k = 0; k < static_cast<int>(time_.size()); ++k) {
      const double step = piece.empty() ? period_ : time_[k] - time_[piece.back()];
      if (step < kTooSoon * period_) continue;
      if (step > kGap * period_ && step > std::min(kBridged * period_, kBridged_s)) visit_piece(piece);
      piece.push_back(k);
    }
    visit_piece(piece);
  }

  /// Passes the rows of a piece on, with a stale row for each lost one, and empties the piece.
  void visit_piece(std::vector<int>& piece) {
    if (static_cast<int>(piece.size()) >= kSmallestStretch) {
      RawStretch s = filled(piece);
      bridge_stale_torque(s);
      visit_(s);
    }
    piece.clear();
  }

  RawStretch filled(const std::vector<int>& piece) const {
    std::vector<double> time;
    std::vector<int> row, lost;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const double t = time_[piece[i]], step = i > 0 ? t - time.back() : 0.0;
      const int missing = step > kGap * period_ ? static_cast<int>(std::lround(step / period_)) - 1 : 0;
      for (int m = missing; m > 0; --m) {
        time.push_back(t - step * m / (missing + 1));
        row.push_back(piece[i - 1]);
        lost.push_back(1);
      }
      time.push_back(t);
      row.push_back(piece[i]);
      lost.push_back(stale_[piece[i]]);
    }
    const int n = static_cast<int>(time.size());
    RawStretch s;
    s.time = Eigen::Map<const Eigen::VectorXd>(time.data(), n);
    s.stale = Eigen::Map<const Eigen::VectorXi>(lost.data(), n);
    s.q.resize(joints_, n);
    s.tau.resize(joints_, n);
    if (has_dq_) s.dq.resize(joints_, n);
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < joints_; ++j) {
        const double* v = values_.data() + 3 * (static_cast<std::ptrdiff_t>(row[k]) * joints_ + j);
        s.q(j, k) = v[0];
        if (has_dq_) s.dq(j, k) = v[1];
        s.tau(j, k) = v[2];
      }
    return s;
  }

  /// Interpolates the torque of stale rows linearly.
  static void bridge_stale_torque(RawStretch& s) {
    for (int k = 1; k + 1 < s.rows(); ++k) {
      if (!s.stale[k]) continue;
      int next = k + 1;
      while (next + 1 < s.rows() && s.stale[next]) ++next;
      const double x = (s.time[k] - s.time[k - 1]) / (s.time[next] - s.time[k - 1]);
      s.tau.col(k) = (1.0 - x) * s.tau.col(k - 1) + x * s.tau.col(next);
    }
  }

  int joints_;
  RepeatedRows repeated_;
  const std::function<void(const RawStretch&)>& visit_;
  bool has_dq_ = false;
  double period_ = 0.0, skipped_s_ = 0.0, last_time_ = 0.0;
  std::int64_t rows_ = 0;
  std::vector<double> time_, values_;
  std::vector<int> stale_;
};

void check_channels(const LogSource& source, const Log& segment, int joints) {
  const auto fail = [&](const std::string& message) {
    throw Error(ErrorCode::input, source.identity().path, message);
  };
  if (segment.joints() != joints)
    fail(joint_count_sentence(source.issues(), segment.joints(), "the robot file", joints));
  if (static_cast<int>(segment.tau.size()) != joints)
    fail(
        "does not have the torque of every joint; identification needs tau1.. or [log.columns] that name "
        "their columns");
}

constexpr double kOutlier = 20.0;  ///< times the 90 % quantile of the distance from the neighbours' mean

/// Marks samples that are far from the mean of their neighbours while these agree with each other.
void switch_off_outliers(const Eigen::VectorXd& y, Eigen::VectorXi& off) {
  const int n = static_cast<int>(y.size());
  std::vector<double> bends;
  for (int k = 1; k + 1 < n; ++k) bends.push_back(std::abs(y[k] - 0.5 * (y[k - 1] + y[k + 1])));
  if (bends.empty()) return;
  const double usual = std::max(upper_quantile(bends, 0.9), 1e-9 * (1.0 + y.cwiseAbs().mean()));
  for (int k = 1; k + 1 < n; ++k)
    if (bends[k - 1] > kOutlier * usual && bends[k - 1] > 2.0 * std::abs(y[k + 1] - y[k - 1])) off[k] = 1;
}

}  // namespace

StretchSummary for_each_raw_stretch(LogSource& source, int joints, RepeatedRows repeated,
                                    const std::function<void(const RawStretch&)>& visit) {
  source.rewind();
  StretchCutter cutter(joints, repeated, visit);
  Log segment;
  while (source.next(segment)) {
    check_channels(source, segment, joints);
    cutter.add(segment);
  }
  return cutter.finish();
}

JointMotion joint_motion(const RawStretch& s, int j) {
  JointMotion m;
  m.time = s.time;
  m.q = s.q.row(j);
  m.q_off = s.stale;
  switch_off_outliers(m.q, m.q_off);
  if (s.dq.size() == 0) return m;
  m.dq = s.dq.row(j);
  m.dq_off = s.stale;
  switch_off_outliers(m.dq, m.dq_off);
  return m;
}

}  // namespace faultline
