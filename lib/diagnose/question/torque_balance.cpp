// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/torque_balance.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/motion/stretch.hpp"
#include "lib/log/log_source.hpp"
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
constexpr double kFitsWell = 0.06;     // misfit below which one moment is enough
constexpr double kLeastMisfit = 0.01;  // below it, all interpretations are right
constexpr double kOtherVelocity =
    1.0;                             // misfit of a velocity in another unit than its position: fits nothing
constexpr double kMostOffset = 0.3;  // of the largest healthy torque: bound of the offset fitted to a block

/// The torque of one joint as means over windows of a tenth of a second or more in which the joint moves, in
/// the order of time.
struct JointBalance {
  std::vector<double> logged;   ///< N m or N
  std::vector<double> body;     ///< required for inertia and gravity along the logged motion, N m or N
  std::vector<double> braking;  ///< required for friction and ripple, N m or N

  std::size_t windows() const { return logged.size(); }
};

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

/// Misfit of a block of windows with the offset and friction that fit it best (JointMatch::misfits); NaN if
/// its torque is too small.
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

std::vector<double> misfits(const JointBalance& balance, double torque_scale) {
  std::vector<double> out;
  for (std::size_t first = 0; first + kFewestOfBlock <= balance.windows(); first += kBlock) {
    const double left = misfit(balance, first, std::min(kBlock, balance.windows() - first), torque_scale);
    if (std::isfinite(left)) out.push_back(left);
  }
  return out;
}

/// Sets the ratio of the torques, and its residual.
void fit_ratio(const JointBalance& b, double torque_scale, JointMatch& fit) {
  const std::size_t count = b.windows();
  if (count < kFewestOfBlock) return;
  const Eigen::ArrayXd logged = part(b.logged, 0, count),
                       needed = part(b.body, 0, count) + part(b.braking, 0, count);
  const Eigen::ArrayXd varying = needed - needed.mean();
  const double spread = varying.square().mean();
  if (!(std::sqrt(spread) > kLeastRatioShare * torque_scale)) return;
  fit.torque_ratio = ((logged - logged.mean()) * varying).mean() / spread;
  const Eigen::ArrayXd left = logged - logged.mean() - fit.torque_ratio * varying;
  fit.ratio_residual =
      std::sqrt(left.square().mean() / std::max(variation(logged) * variation(logged), 1e-300));
}

/// The misfit that `count` blocks do not exceed; with fewer blocks, the largest. 0 without any.
double best_blocks(std::vector<double> of_joint, std::size_t count) {
  if (of_joint.empty()) return 0.0;
  const std::size_t last = std::min(count, of_joint.size()) - 1;
  std::nth_element(of_joint.begin(), of_joint.begin() + static_cast<std::ptrdiff_t>(last), of_joint.end());
  return of_joint[last];
}

/// The misfit that a third of the blocks, at least two, do not exceed: a fault may begin soon.
double usual_misfit(const std::vector<double>& of_joint) {
  return best_blocks(of_joint, std::max((of_joint.size() + 2) / 3, std::size_t{2}));
}

/// Returns the torques of the windows of a log, by joint.
std::vector<JointBalance> torque_balance(LogSource& log, const LogSurvey& survey, const KnownRobot& robot) {
  const int joints = robot.joints();
  std::vector<Stretch> stretches;
  log.rewind();
  for_each_stretch(log, 0, joints, survey, 1, [&](const Stretch& stretch) { stretches.push_back(stretch); });
  Eigen::VectorXd fastest = Eigen::VectorXd::Zero(joints);  // bounded by the healthy logs
  for (const Stretch& s : stretches) fastest = fastest.cwiseMax(s.dq_smooth.cwiseAbs().rowwise().maxCoeff());
  for (int j = 0; j < joints; ++j)
    fastest[j] = std::min(fastest[j], kFastest * robot.usual.velocity_scale[j]);
  std::vector<JointBalance> out(joints);
  for (const Stretch& s : stretches) add_windows(s, robot, fastest, out);
  return out;
}

}  // namespace

std::vector<JointMatch> fit_to_robot(const Log& log, const KnownRobot& robot) {
  std::vector<JointMatch> out(robot.joints());
  MemorySource source(log, "excerpt");
  try {
    const LogSurvey survey = survey_log(source, robot.joints());
    const std::vector<JointBalance> balance = torque_balance(source, survey, robot);
    for (int j = 0; j < robot.joints(); ++j) {
      const double scale = robot.usual.torque_scale[j];
      if (scale > 0.0) out[j].misfits = misfits(balance[j], scale);
      if (survey.velocity[j].is_other_unit()) out[j].velocity_factor = 1.0 / survey.velocity[j].factor;
      fit_ratio(balance[j], scale, out[j]);
    }
  } catch (const Error&) {
    return std::vector<JointMatch>(robot.joints());  // the log has no motion to compare
  }
  return out;
}

double best_misfit(const std::vector<double>& of_joint) {
  const double best = best_blocks(of_joint, 1);
  if (best < kFitsWell || of_joint.size() < 2) return best;
  double pair = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < of_joint.size(); ++i)
    pair = std::min(pair, std::max(of_joint[i - 1], of_joint[i]));
  return pair;
}

FitScore score_of(const std::vector<JointMatch>& fit) {
  FitScore out;
  int determined = 0;
  for (const JointMatch& joint : fit) {
    if (!joint.is_determined()) continue;
    const double apart = joint.velocity_factor == 1.0 ? 0.0 : kOtherVelocity;
    const double best = std::max(best_misfit(joint.misfits), apart);
    const double usual = std::max(usual_misfit(joint.misfits), apart);
    out.worst = std::max(out.worst, best);
    out.usual = std::max(out.usual, usual);
    out.log_mean += 0.5 * (elementary::log(std::max(best, kLeastMisfit)) +
                           elementary::log(std::max(usual, kLeastMisfit)));
    ++determined;
  }
  if (determined > 0) out.log_mean /= determined;
  return out;
}

}  // namespace faultline
