// SPDX-License-Identifier: MIT
#include "lib/log/transformed/coupled_source.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/log.hpp"
#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

constexpr double kDust = 1e-14;  ///< limit of rounding errors of a zero, relative to the largest entry

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd inverse = matrix.inverse();
  const double largest = inverse.cwiseAbs().maxCoeff();
  return inverse.unaryExpr([&](double x) { return std::abs(x) < kDust * largest ? 0.0 : x; });
}

/// Replaces each signal by a sum of all signals, weighted by its row of `matrix`; a weight of 0 skips one.
void mix(JointSignals& signals, const Eigen::MatrixXd& matrix, JointSignals& mixed) {
  mixed.resize(signals.size());
  for (std::size_t j = 0; j < signals.size(); ++j) {
    mixed[j].assign(signals[j].size(), 0.0);
    for (std::size_t k = 0; k < signals.size(); ++k) {
      const double weight = matrix(static_cast<int>(j), static_cast<int>(k));
      if (weight == 0.0) continue;
      for (std::size_t i = 0; i < mixed[j].size(); ++i) mixed[j][i] += weight * signals[k][i];
    }
  }
  std::swap(signals, mixed);
}

void mix_all(Log& log, const Eigen::MatrixXd& motion, const Eigen::MatrixXd& torque, JointSignals& mixed) {
  for (const Quantity quantity : kJointQuantities)
    mix(signals_of(log, quantity), is_torque(quantity) ? torque : motion, mixed);
}

class Coupling {
 public:
  explicit Coupling(const Eigen::MatrixXd& coupling)
      : motion_(coupling), torque_(inverse_of(coupling).transpose()) {}

  bool next(LogSource& source, Log& segment) {
    if (!source.next(segment)) return false;
    if (segment.joints() != motion_.rows())
      throw Error(ErrorCode::input, source.identity().path,
                  joint_count_sentence(source.issues(), segment.joints(), "the coupling of the robot",
                                       static_cast<int>(motion_.rows())));
    mix_all(segment, motion_, torque_, mixed_);
    return true;
  }

 private:
  Eigen::MatrixXd motion_, torque_;
  JointSignals mixed_;  ///< storage that next() reuses
};

}  // namespace

std::unique_ptr<LogSource> coupled(std::unique_ptr<LogSource> source, const Eigen::MatrixXd& coupling) {
  if (coupling.size() == 0) return source;
  return std::make_unique<StagedSource<Coupling>>(std::move(source), Coupling(coupling));
}

Log uncoupled(Log log, const Eigen::MatrixXd& coupling) {
  JointSignals mixed;
  if (coupling.size() > 0) mix_all(log, inverse_of(coupling), coupling.transpose(), mixed);
  return log;
}

}  // namespace faultline
