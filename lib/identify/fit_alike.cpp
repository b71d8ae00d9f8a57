// SPDX-License-Identifier: MIT
#include "lib/identify/fit_alike.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_table.hpp"
#include "lib/identify/shooting.hpp"
#include "lib/identify/start_fit.hpp"
#include "lib/identify/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kWidthDoubt = 1.15;  ///< of ln(width): a factor of about 3

double nominal_timing(const Robot& robot) {
  if (robot.log.torque_between_samples == TorqueTiming::held) return 0.0;
  return robot.torque_phi.value_or(0.5);
}

/// Facts with doubt about parameters of the space, and a wide one about every friction width.
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
    priors.push_back({space.log_width(j), std::log(robot.chain.friction[j].width), kWidthDoubt});
  return priors;
}

bool has_fast_log(const Identification& id) {
  return std::any_of(id.logs.begin(), id.logs.end(),
                     [](const IdentifiedLog& log) { return log.sample_period_s < kShowsFriction_s; });
}

std::vector<int> free_parameters(const WeakFit& weak, const Identification& id,
                                 const IdentifyOptions& options) {
  const ParameterSpace& space = id.space;
  const bool is_fast = has_fast_log(id);
  std::vector<int> free;
  for (int p = 0; p < space.linear(); ++p)
    if (weak.free[p]) free.push_back(p);
  for (int j = 0; j < space.joints(); ++j)
    if (options.estimate_width && is_fast && weak.free[space.coulomb(j)]) free.push_back(space.log_width(j));
  return free;
}

int thread_count(const IdentifyOptions& options) {
  return options.threads > 0 ? options.threads
                             : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ShootingFit shoot(const WeakFit& weak, Gathered& gathered, const Identification& id,
                  const IdentifyOptions& options, const Progress& progress) {
  const std::vector<Excerpt> excerpts = gathered.excerpts.take();
  ShootingOptions shooting;
  shooting.max_iterations = options.max_iterations;
  shooting.threads = thread_count(options);
  return fit_shooting({.space = id.space,
                       .excerpts = excerpts,
                       .start = weak.parameters,
                       .free = free_parameters(weak, id, options),
                       .priors = priors_of(id.space, id.robot),
                       .noise = first_noise(gathered.roughness),
                       .floor = noise_floor(gathered.roughness)},
                      shooting, progress);
}

Issue model_error_issue() {
  Issue issue;
  issue.code = "model_error";
  issue.severity = Severity::note;
  issue.message =
      "the motion keeps a regular error that no parameters of this model remove; values and intervals come "
      "from the momentum balance over short windows instead of the output error";
  return issue;
}

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

/// What is left after shooting is motion the model lacks, not noise: neighbours alike and far above
/// roughness.
bool model_error_dominates(const ShootingFit& shot, const Eigen::VectorXd& roughness,
                           const Eigen::VectorXd& floor) {
  for (Eigen::Index c = 0; c < roughness.size(); ++c)
    if (shot.correlation[c] > 0.7 && shot.noise[c] > 3.0 * std::max(roughness[c], floor[c])) return true;
  return false;
}

void take_weak_form(const WeakFit& weak, const Gathered& gathered, Identification& id) {
  const Eigen::VectorXd noise = first_noise(gathered.roughness).cwiseMax(noise_floor(gathered.roughness));
  id.method = IdentifyMethod::weak_form;
  id.status = IdentificationStatus::converged;
  id.estimate = weak.parameters;
  id.covariance = weak.covariance;
  id.q_noise = list(noise.head(id.space.joints()));
  if (gathered.roughness.has_dq()) id.dq_noise = list(noise.tail(id.space.joints()));
  id.reason = fmt::format("{} windows", weak.windows);
}

void take_shooting(const ShootingFit& shot, const Gathered& gathered, Identification& id) {
  id.method = IdentifyMethod::output_error;
  id.status = shot.converged ? IdentificationStatus::converged : IdentificationStatus::not_converged;
  id.reason = shot.reason;
  id.estimate = shot.parameters;
  id.covariance = shot.covariance;
  id.q_noise = list(shot.noise.head(id.space.joints()));
  if (gathered.roughness.has_dq()) id.dq_noise = list(shot.noise.tail(id.space.joints()));
}

/// Fit in torque over the weak form's windows, whichever estimator gave the parameters.
void judge_fit(const WeakWindows& windows, Identification& id) {
  const WeakFit judged = fit_weak_form(windows, id.estimate, std::vector<bool>(id.space.count(), false));
  id.residual_rms = judged.residual_rms;
  id.fit_r2 = judged.r2;
}

/// Sharp friction serves the regression; a robot that is to be simulated keeps the width of its file.
void smooth_friction(const Eigen::VectorXd& nominal, Identification& id) {
  for (int j = 0; j < id.space.joints(); ++j) {
    double& width = id.estimate[id.space.log_width(j)];
    width = std::max(width, nominal[id.space.log_width(j)]);
  }
}

/// A mass or inertia that only joints at rest show is confounded with their stiction.
void doubt_still_joints(const WeakWindows& windows, const std::vector<int>& still, WeakFit& weak) {
  constexpr double kShown = 1e-6;  ///< share of the squared column that moving joints must carry
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(windows.space().joints(), windows.space().rigid());
  for (const WeakWindow& w : windows.all()) square += w.base.cwiseAbs2();
  const Eigen::RowVectorXd all = square.colwise().sum();
  for (int joint : still) square.row(joint - 1).setZero();
  for (int p = 0; p < windows.space().rigid(); ++p)
    if (square.col(p).sum() <= kShown * all[p]) weak.confounded[p] = true;
}

}  // namespace

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress) {
  AlikeFit fit;
  Identification& id = fit.id;
  id.robot = robot;
  id.space = parameter_space(robot);
  Gathered gathered{WeakWindows(id.space, options.window_s, options.max_windows),
                    Excerpts(options.segment_s, options.min_segment_rows, options.max_rows),
                    {}};
  gather(logs, progress, gathered, id);

  const std::vector<int> still = still_joints(gathered.roughness);
  const Eigen::VectorXd nominal = parameters_of(id.space, robot.chain, nominal_timing(robot));
  std::vector<bool> wanted = wanted_parameters(id.space, robot, still);
  WeakFit weak =
      start_fit(gathered.windows, nominal, options.estimate_offset && has_fast_log(id), robot, wanted);

  bool weak_is_final = options.method == IdentifyMethod::weak_form;
  if (!weak_is_final) {
    const ShootingFit shot = shoot(weak, gathered, id, options, progress);
    take_shooting(shot, gathered, id);
    weak_is_final = options.method == IdentifyMethod::automatic &&
                    model_error_dominates(shot, gathered.roughness.std(), noise_floor(gathered.roughness));
    if (weak_is_final) id.issues.add(model_error_issue());
  }
  if (weak_is_final) {
    if (options.estimate_width) weak = fit_weak_form_and_width(gathered.windows, nominal, wanted);
    take_weak_form(weak, gathered, id);
  }

  doubt_still_joints(gathered.windows, still, weak);
  id.condition_number = weak.condition_number;
  judge_fit(gathered.windows, id);
  if (weak_is_final) smooth_friction(nominal, id);
  list_base_parameters(weak, {wanted, still, has_fast_log(id)}, id);
  if (!all_told(id) && id.status == IdentificationStatus::converged) {
    id.status = IdentificationStatus::poorly_excited;
    id.reason += "; " + not_excited(still);
  }
  for (int p = 0; p < id.space.rigid(); ++p) fit.usable.push_back(weak.free[p] && !weak.confounded[p]);
  return fit;
}

}  // namespace faultline
