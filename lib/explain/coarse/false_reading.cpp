// SPDX-License-Identifier: MIT
#include "lib/explain/coarse/false_reading.hpp"

namespace faultline {

Eigen::MatrixXd read_column(const CoarseLog& log, const CoarseGuess& guess, int from) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(log.read.rows(), log.samples());
  const int j = guess.joint - 1, n = log.joints();
  for (int k = from; k < log.samples(); ++k) {
    out(j, k) = guess.kind == FaultKind::sensor_bias ? 1.0 : log.time_s(k) - guess.onset_s;
    if (guess.kind == FaultKind::sensor_drift && !guess.velocity_is_true) out(n + j, k) = 1.0;
  }
  return out;
}

}  // namespace faultline
