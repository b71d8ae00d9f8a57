// SPDX-License-Identifier: MIT
#include "lib/identify/motion/stretch.hpp"

#include <algorithm>

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

}  // namespace

void for_each_stretch(LogSource& source, int log, int joints, const LogSurvey& survey, int stride,
                      const std::function<void(const Stretch&)>& visit) {
  int seen = 0;
  for_each_raw_stretch(source, joints, survey.repeated_rows, [&](const RawStretch& raw) {
    if (seen++ % stride == 0) visit(smoothed(raw, log, survey));
  });
}

}  // namespace faultline
