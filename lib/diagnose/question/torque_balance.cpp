// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/torque_balance.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lib/core/error.hpp"
#include "lib/identify/motion/stretch.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kWindow_s = 0.1;  // s over which torques are averaged: less noise of the acceleration
constexpr int kFewestSteps = 3;    // steps of a window, at least
constexpr std::size_t kBlock = 6;  // windows of a block, for which one misfit is computed
constexpr std::size_t kFewestOfBlock = 4;  // windows of a block, at least: two numbers are fitted to them
constexpr double kFastest = 3.0;  // times the rms of the healthy speed: bound of the joint's largest speed
constexpr double kMoves = 0.05;   // share of the joint's largest speed: a slower window is at rest
constexpr double kLeastRatioShare = 0.05;  // of the largest healthy torque: least variation for a ratio
constexpr double kLeastShare = 0.1;        // of the same: least variation in a block
constexpr double kLeastHeld = 0.3;         // of the same: least mean torque of a block that varies less
// Times the friction of the model: bounds of the friction that is fitted to a block of windows.
constexpr double kBalanceLeastFriction = 0.5, kMostFriction = 2.0;
constexpr double kMostOffset = 0.3;  // of the largest healthy torque: bound of the offset fitted to a block

/// Torque that the robot needs in each row of a stretch, N m or N.
struct Rows {
  Eigen::MatrixXd body, braking;  // joints x rows
};

Rows needed_in(const Stretch& s, const Chain& chain) {
  const int n = s.joints(), rows = s.rows();
  Rows out{Eigen::MatrixXd(n, rows), Eigen::MatrixXd(n, rows)};
  for (int k = 0; k < rows; ++k) {
    const int before = std::max(k - 1, 0), after = std::min(k + 1, rows - 1);
    const JointVector q = s.q_smooth.col(k), dq = s.dq_smooth.col(k);
    const JointVector ddq =
        (s.dq_smooth.col(after) - s.dq_smooth.col(before)) / (s.time[after] - s.time[before]);
    const JointVector body = rigid_body_torque(chain, q, dq, ddq, chain.gravity);
    out.body.col(k) = body;
    out.braking.col(k) = inverse_dynamics(chain, q, dq, ddq) - body;
  }
  return out;
}

/// Mean over the steps between `count` + 1 rows; `share` is the weight of each step's end.
template <typename Row>
double mean_of_steps(const Row& row, int first, int count, double share) {
  return (1.0 - share) * row.segment(first, count).mean() + share * row.segment(first + 1, count).mean();
}

void add_windows(const Stretch& s, const KnownRobot& robot, const Eigen::VectorXd& fastest,
                 std::vector<JointBalance>& out) {
  constexpr double kTrapezoid = 0.5;  // share of each step's end in the mean: the trapezoidal rule
  const Rows needed = needed_in(s, robot.chain());
  const int steps = std::max(kFewestSteps, static_cast<int>(std::ceil(kWindow_s / s.period_s)));
  for (int first = 0; first + steps < s.rows(); first += steps)
    for (int j = 0; j < s.joints(); ++j) {
      const double speed = s.dq_smooth.row(j).segment(first, steps).cwiseAbs().mean();
      if (!(speed > kMoves * fastest[j])) continue;
      out[j].time_s.push_back(s.time[first]);
      out[j].logged.push_back(mean_of_steps(s.tau.row(j), first, steps, robot.torque_phi()));
      out[j].body.push_back(mean_of_steps(needed.body.row(j), first, steps, kTrapezoid));
      out[j].braking.push_back(mean_of_steps(needed.braking.row(j), first, steps, kTrapezoid));
    }
}

Eigen::Map<const Eigen::ArrayXd> part(const std::vector<double>& values, std::size_t first,
                                      std::size_t count) {
  return {values.data() + first, static_cast<Eigen::Index>(count)};
}

double variation(const Eigen::ArrayXd& values) { return std::sqrt((values - values.mean()).square().mean()); }

/// Misfit of a block of windows with the offset and friction that fit it best (misfits()); NaN if its torque
/// is too small.
double misfit(const JointBalance& b, std::size_t first, std::size_t count, double torque_scale) {
  const Eigen::ArrayXd logged = part(b.logged, first, count), body = part(b.body, first, count),
                       braking = part(b.braking, first, count);
  const Eigen::ArrayXd rest = logged - body, varying = braking - braking.mean();
  const double spread = varying.square().sum();
  const double friction =
      spread > 0.0 ? std::clamp((rest * varying).sum() / spread, kBalanceLeastFriction, kMostFriction) : 1.0;
  const Eigen::ArrayXd left = rest - friction * braking;
  const double most = kMostOffset * torque_scale;
  const double varies = std::max(variation(logged), variation(body + braking));
  if (varies > kLeastShare * torque_scale)
    return std::sqrt((left - std::clamp(left.mean(), -most, most)).square().mean()) / varies;
  const double held = std::max(std::abs(logged.mean()), std::abs((body + braking).mean()));
  return held > kLeastHeld * torque_scale ? std::sqrt(left.square().mean()) / held
                                          : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<JointBalance> torque_balance(const Log& log, const KnownRobot& robot) {
  const Chain& chain = robot.chain();
  std::vector<JointBalance> out(chain.joints());
  MemorySource source(log, "excerpt");
  try {
    const LogSurvey survey = survey_log(source, chain.joints());
    for (int j = 0; j < chain.joints(); ++j)
      if (survey.velocity[j].is_other_unit()) out[j].velocity_factor = 1.0 / survey.velocity[j].factor;
    std::vector<Stretch> stretches;
    source.rewind();
    for_each_stretch(source, 0, chain.joints(), survey, 1,
                     [&](const Stretch& stretch) { stretches.push_back(stretch); });
    Eigen::VectorXd fastest = Eigen::VectorXd::Zero(chain.joints());  // bounded by the healthy logs
    for (const Stretch& s : stretches)
      fastest = fastest.cwiseMax(s.dq_smooth.cwiseAbs().rowwise().maxCoeff());
    for (int j = 0; j < chain.joints(); ++j)
      fastest[j] = std::min(fastest[j], kFastest * robot.usual.velocity_scale[j]);
    for (const Stretch& s : stretches) add_windows(s, robot, fastest, out);
  } catch (const Error&) {
    return std::vector<JointBalance>(chain.joints());  // no motion that can be compared with a robot
  }
  return out;
}

std::vector<double> misfits(const JointBalance& balance, double torque_scale) {
  std::vector<double> out;
  for (std::size_t first = 0; first + kFewestOfBlock <= balance.windows(); first += kBlock) {
    const double left = misfit(balance, first, std::min(kBlock, balance.windows() - first), torque_scale);
    if (std::isfinite(left)) out.push_back(left);
  }
  return out;
}

TorqueRatio torque_ratio(const JointBalance& b, double torque_scale) {
  const std::size_t count = b.windows();
  if (count < kFewestOfBlock) return {};
  const Eigen::ArrayXd logged = part(b.logged, 0, count),
                       needed = part(b.body, 0, count) + part(b.braking, 0, count);
  const Eigen::ArrayXd varying = needed - needed.mean();
  const double spread = varying.square().mean();
  if (!(std::sqrt(spread) > kLeastRatioShare * torque_scale)) return {};
  const double ratio = ((logged - logged.mean()) * varying).mean() / spread;
  const Eigen::ArrayXd left = logged - logged.mean() - ratio * varying;
  return {ratio, std::sqrt(left.square().mean() / std::max(variation(logged) * variation(logged), 1e-300))};
}

}  // namespace faultline
