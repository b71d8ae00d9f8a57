// SPDX-License-Identifier: MIT
#include "lib/identify/shooting_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/identify/feasible/feasible.hpp"
#include "lib/identify/parameter_table.hpp"

namespace faultline {
namespace {

constexpr double kSegment_s = 0.25;         // length of a segment on logs of 100 Hz and above
constexpr int kFewestSegmentRows = 8;       // of a segment on slower logs
constexpr double kWidthDoubt = 1.15;        // of ln(width): a factor of about 3
constexpr std::size_t kTrialExcerpts = 40;  // of the trial, and fewer than twice as many
constexpr int kMostSolves = 6;              // each with noise and outlier weights measured anew
constexpr int kTrialRounds = 2;             // with the noise measured anew: enough to show a systematic error
constexpr int kTrialIterations = 12;        // at most, of a solve in the trial
constexpr double kRegular = 0.7;            // correlation of neighbouring residuals: more is not noise
constexpr double kFarAboveNoise = 3.0;  // times the log's noise: beyond, a correlated residual is model error
constexpr double kWorseTorque = 1.15;   // torque residual over that of the torque fit, and
constexpr double kTorqueLost = 2e-4;    // of the mean square torque: a smaller loss is accepted
constexpr double kWork = 4e7;           // rows x joints^2 x (2 joints + free): some seconds
constexpr int kFewestRows = 4000;       // of the excerpts, however many joints there are

/// Returns the uncertain facts about parameters of the space, and a wide prior of every friction width.
std::vector<ParameterPrior> priors_of(const ParameterSpace& space, const Robot& robot) {
  std::vector<ParameterPrior> priors;
  for (int p = 0; p < space.timing(); ++p) {
    std::string name = space.name(p);
    std::erase(name, '_');
    const auto it = robot.known.find(name);
    if (it != robot.known.end() && it->second.std > 0.0)
      priors.push_back({p, it->second.value, it->second.std});
  }
  for (int j = 0; j < space.joints(); ++j)
    priors.push_back({space.log_width(j), elementary::log(robot.chain.friction[j].width), kWidthDoubt});
  return priors;
}

std::vector<int> free_parameters(const WeakFit& weak, const Identification& id) {
  const ParameterSpace& space = id.space;
  const bool is_fast = has_fast_log(id);
  std::vector<int> free;
  for (int p = 0; p < space.linear(); ++p)
    if (weak.free[p]) free.push_back(p);
  for (int j = 0; j < space.joints(); ++j)
    if (is_fast && weak.free[space.coulomb(j)]) free.push_back(space.log_width(j));
  return free;
}

/// Returns the number of rows that shooting can afford: the work grows with the cube of the joints.
int affordable_rows(const ParameterSpace& space, std::size_t free, int most) {
  const double n = space.joints(), each = n * n * (2.0 * n + static_cast<double>(free));
  return std::clamp(static_cast<int>(kWork / each), kFewestRows, std::max(most, kFewestRows));
}

/// Whether the residual of shooting is unmodelled motion, not noise: neighbours alike and far above noise.
bool model_error_dominates(const ShootingFit& shot, const Eigen::VectorXd& noise) {
  for (Eigen::Index c = 0; c < noise.size(); ++c)
    if (shot.correlation[c] > kRegular && shot.noise[c] > kFarAboveNoise * noise[c]) return true;
  return false;
}

std::vector<Excerpt> some_of(const std::vector<Excerpt>& all) {
  std::vector<Excerpt> out;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kTrialExcerpts);
  for (std::size_t i = 0; i < all.size(); i += stride) out.push_back(all[i]);
  return out;
}

/// Returns the largest increase of a joint's torque residual by `parameters` over the torque fit, as a share
/// of its mean square torque; 0 without a clear increase.
double torque_lost(const TorqueFit& torque, const ParameterSpace& space, const Eigen::VectorXd& parameters) {
  const Eigen::VectorXd left = torque.system.y - torque.system.a * parameters.head(space.linear());
  Eigen::VectorXd with = Eigen::VectorXd::Zero(space.joints()), without = with, all = with;
  for (Eigen::Index k = 0; k < left.size(); ++k) {
    const int j = torque.system.joint[k];
    with[j] += torque.fit.weight[k] * left[k] * left[k];
    without[j] += torque.fit.weight[k] * torque.fit.residual[k] * torque.fit.residual[k];
    all[j] += torque.fit.weight[k] * torque.system.y[k] * torque.system.y[k];
  }
  double worst = 0.0;
  for (int j = 0; j < space.joints(); ++j)
    if (with[j] > kWorseTorque * kWorseTorque * without[j] && all[j] > 0.0)
      worst = std::max(worst, (with[j] - without[j]) / all[j]);
  return worst;
}

std::string refusal(const ShootingFit& shot, const Gathered& gathered, const TorqueFit& torque,
                    const Identification& id) {
  const Measurements& m = gathered.measurements;
  if (model_error_dominates(shot, m.noise()))
    return "the fit of the motion has a systematic error that no parameters of this model remove";
  // On slow logs a fit that was only stopped early is still more accurate than windows of few samples.
  if (!shot.converged && has_fast_log(id)) return "the fit of the motion did not converge";
  const std::string wrong = infeasibility(id.space, shot.parameters, shot.covariance, m.q_low(), m.q_high());
  if (!wrong.empty()) return "in the fit of the motion " + wrong;
  if (!has_fast_log(id)) return "";  // windows of so few samples do not determine the torque better
  const double lost = torque_lost(torque, id.space, shot.parameters);
  if (lost > kTorqueLost)
    return fmt::format("the fit of the motion explains {:.2g} % less of some joint's torque", 100.0 * lost);
  return "";
}

}  // namespace

ShootingOutcome shoot(std::span<LogSource* const> logs, const Gathered& gathered, const TorqueFit& torque,
                      const Identification& id, const IdentifyOptions& options, const Progress& progress) {
  const std::vector<int> free = free_parameters(torque.fit, id);
  const int rows = affordable_rows(id.space, free.size(), options.max_rows);
  const std::vector<Excerpt> excerpts =
      gather_excerpts(logs, gathered, torque.shift, Excerpts(kSegment_s, kFewestSegmentRows, rows));
  ShootingOutcome out;
  if (excerpts.empty()) {
    out.refused = "no stretch of the logs is long enough to fit its motion";
    return out;
  }
  const std::vector<Excerpt> few = some_of(excerpts);
  ShootingProblem problem{.space = id.space,
                          .excerpts = few,
                          .start = torque.fit.parameters,
                          .free = free,
                          .priors = priors_of(id.space, id.robot),
                          .noise = gathered.measurements.noise(),
                          .floor = gathered.measurements.floor(),
                          .max_iterations = kTrialIterations,
                          .max_rounds = kTrialRounds,
                          .threads = options.threads};
  const ShootingFit trial = fit_shooting(problem, {});
  if (options.method == IdentifyMethod::automatic &&
      model_error_dominates(trial, gathered.measurements.noise())) {
    out.refused = "the fit of the motion has a systematic error that no parameters of this model remove";
    return out;
  }
  problem.excerpts = excerpts;
  if (trial.converged) problem.start = trial.parameters;
  problem.max_iterations = options.max_iterations;
  problem.max_rounds = kMostSolves;
  out.fit = fit_shooting(problem, progress);
  out.refused = refusal(out.fit, gathered, torque, id);
  return out;
}

}  // namespace faultline
