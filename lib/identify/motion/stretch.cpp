// SPDX-License-Identifier: MIT
#include "lib/identify/motion/stretch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/identify/motion/raw_stretch.hpp"

namespace faultline {
namespace {

Stretch smoothed(const RawStretch& raw, int log, const LogSurvey& survey) {
  const int n = raw.joints(), rows = raw.rows();
  Stretch s;
  s.log = log;
  s.period_s = survey.summary.period_s;
  s.time = raw.time;
  s.q = raw.q;
  s.tau = raw.tau;
  s.dq.resize(n, rows);
  s.q_smooth.resize(n, rows);
  s.dq_smooth.resize(n, rows);
  s.outlier.setOnes(2 * n, rows);
  s.noise.setZero(2 * n);
  for (int j = 0; j < n; ++j) {
    JointMotion m = joint_motion(raw, j);
    if (!survey.measures_velocity(j)) m.dq.resize(0);
    const SmoothMotion smooth = smooth_motion(m, survey.noise[j]);
    const bool measured = m.dq.size() > 0;
    s.has_dq = s.has_dq || measured;
    s.q_smooth.row(j) = smooth.q;
    s.dq_smooth.row(j) = smooth.dq;
    s.dq.row(j) = measured ? m.dq : smooth.dq;
    s.outlier.row(j) = m.q_off;
    if (measured) s.outlier.row(n + j) = m.dq_off;
    s.noise[j] = survey.noise[j].q_std;
    s.noise[n + j] = survey.noise[j].dq_std;
  }
  return s;
}

Excerpt cut(const Stretch& s, int begin, int rows) {
  const int n = s.joints();
  Excerpt e;
  e.log = s.log;
  e.time = s.time.segment(begin, rows);
  e.tau = s.tau.middleCols(begin, rows);
  e.measured.resize(2 * n, rows);
  e.measured << s.q.middleCols(begin, rows), s.dq.middleCols(begin, rows);
  e.weight = (s.outlier.middleCols(begin, rows).array() == 0).cast<double>();
  if (!s.has_dq) e.weight.bottomRows(n).setZero();
  e.start.resize(2 * n);
  e.start << s.q_smooth.col(begin), s.dq_smooth.col(begin);
  e.speed = s.dq_smooth.middleCols(begin, rows);
  e.travel = (e.speed.rowwise().maxCoeff() - e.speed.rowwise().minCoeff()).sum();
  return e;
}

}  // namespace

void for_each_stretch(LogSource& source, int log, int joints, const LogSurvey& survey, int stride,
                      const std::function<void(const Stretch&)>& visit) {
  int seen = 0;
  for_each_raw_stretch(source, joints, survey.repeated_rows, [&](const RawStretch& raw) {
    if (seen++ % stride == 0) visit(smoothed(raw, log, survey));
  });
}

void Excerpts::add(const Stretch& s) {
  const int rows = std::max(min_rows_, static_cast<int>(std::lround(segment_s_ / s.period_s)) + 1);
  for (int begin = 0; begin + rows <= s.rows(); begin += rows) {
    if (seen_++ % stride_ != 0) continue;
    pool_.push_back(cut(s, begin, rows));
    held_rows_ += rows;
    if (held_rows_ <= 2 * max_rows_) continue;
    std::vector<Excerpt> half;
    held_rows_ = 0;
    for (std::size_t i = 0; i < pool_.size(); i += 2) {
      held_rows_ += pool_[i].rows();
      half.push_back(std::move(pool_[i]));
    }
    pool_ = std::move(half);
    stride_ *= 2;
  }
}

std::vector<Excerpt> Excerpts::take() {
  std::vector<int> order(pool_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pool_[a].travel > pool_[b].travel; });
  std::int64_t rows = 0;
  std::vector<int> chosen;
  for (int i : order) {
    if (!chosen.empty() && rows + pool_[i].rows() > max_rows_) break;
    rows += pool_[i].rows();
    chosen.push_back(i);
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<Excerpt> out;
  for (int i : chosen) out.push_back(std::move(pool_[i]));
  pool_.clear();
  return out;
}

}  // namespace faultline
