// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "lib/core/error.hpp"
#include "lib/identify/excerpt.hpp"
#include "lib/identify/physical.hpp"
#include "lib/identify/shooting.hpp"
#include "lib/identify/stretch.hpp"
#include "lib/identify/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kWidthDoubt = 1.15;    ///< of ln(width): a factor of about 3
constexpr double kShowsWidth_s = 0.03;  ///< slower logs step over the velocities where friction bends
constexpr double kStill = 20.0;         ///< times the noise of q: a joint that does not move
constexpr double kClearlyWorse = 1.05;
constexpr double kNormal95 = 1.959963984540054;

/// Which parameters the robot file and the options leave to the logs.
std::vector<bool> wanted_parameters(const ParameterSpace& space, const Robot& robot) {
  std::vector<bool> wanted(space.count(), true);
  const auto is_exact = [&](const std::string& name) {
    const auto it = robot.known.find(name);
    return it != robot.known.end() && it->second.std == 0.0;
  };
  for (int j = 0; j < space.joints(); ++j) {
    const std::string number = std::to_string(j + 1);
    if (is_exact("fv" + number)) wanted[space.viscous(j)] = false;
    if (is_exact("fc" + number)) wanted[space.coulomb(j)] = false;
    wanted[space.offset(j)] = false;
  }
  wanted[space.timing()] = robot.log.torque_between_samples == TorqueTiming::unknown;
  return wanted;
}

double nominal_timing(const Robot& robot) {
  if (robot.log.torque_between_samples == TorqueTiming::held) return 0.0;
  return robot.torque_phi.value_or(0.5);
}

}  // namespace

void IdentifyOptions::check() const {
  const auto positive = [](const char* field, double value) {
    if (!(value > 0.0))
      throw Error(ErrorCode::usage, field, fmt::format("is {}; expected a number above 0", value));
  };
  positive("window_s", window_s);
  positive("segment_s", segment_s);
  positive("min_segment_rows", min_segment_rows - 2);
  positive("max_rows", max_rows);
  positive("max_windows", max_windows);
  positive("max_iterations", max_iterations);
  if (threads < 0)
    throw Error(ErrorCode::usage, "threads", fmt::format("is {}; expected 0 or more", threads));
}

namespace {

/// What one pass over the logs gathers.
struct Gathered {
  WeakWindows windows;
  Excerpts excerpts;
  Roughness roughness;
};

void gather(std::span<LogSource* const> logs, const Progress& progress, Gathered& gathered,
            Identification& id) {
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress("reading", static_cast<double>(i) / static_cast<double>(logs.size()));
    const int log = static_cast<int>(i);
    const auto read = for_each_stretch(*logs[i], log, id.space.joints(), [&](const Stretch& s) {
      gathered.windows.add(s);
      gathered.excerpts.add(s);
      gathered.roughness.add(s);
    });
    const LogIdentity& from = logs[i]->identity();
    id.logs.push_back(
        {from.path, from.sha256, read.rows, gathered.windows.rows_used(log), read.period_s, 0.0});
    id.issues.merge(logs[i]->issues());
  }
  const std::size_t windows = gathered.windows.all().size();
  if (windows < 10)
    throw Error(
        ErrorCode::input, logs.empty() ? "" : logs[0]->identity().path,
        fmt::format("gives {} usable windows in all; identification needs at least 10: give longer logs of a "
                    "moving robot",
                    windows));
}

/// Least noise a channel can have: rounding of its digits.
Eigen::VectorXd noise_floor(const Roughness& roughness) { return (1e-7 * roughness.range()).cwiseMax(1e-9); }

Eigen::VectorXd first_noise(const Roughness& roughness) {
  Eigen::VectorXd noise = roughness.std();
  for (Eigen::Index c = 0; c < noise.size(); ++c)
    if (std::isnan(noise[c])) noise[c] = 0.005 * roughness.range()[c];
  return noise;
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
                     [](const IdentifiedLog& log) { return log.sample_period_s < kShowsWidth_s; });
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

Issue model_error_issue() {
  Issue issue;
  issue.code = "model_error";
  issue.severity = Severity::note;
  issue.message =
      "the motion keeps a regular error that no parameters of this model remove; values and intervals come "
      "from the "
      "momentum balance over short windows instead of the output error";
  return issue;
}

/// Whether the same base parameters mean other torques at other lengths.
bool depends_on_lengths(const ParameterSpace& a, const ParameterSpace& b) {
  const Eigen::VectorXd ones = Eigen::VectorXd::LinSpaced(a.count(), 1.0, 2.0);
  const Eigen::VectorXd same = parameters_of(b, chain_from(a, ones), 0.0);
  return (same - ones).head(a.rigid()).cwiseAbs().maxCoeff() > 1e-6;
}

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

/// Joints whose position hardly changed against its noise in all logs.
std::vector<int> still_joints(const Gathered& gathered, const std::vector<double>& q_noise) {
  std::vector<int> still;
  for (std::size_t j = 0; j < q_noise.size(); ++j)
    if (gathered.roughness.range()[static_cast<Eigen::Index>(j)] < std::max(kStill * q_noise[j], 1e-4))
      still.push_back(static_cast<int>(j) + 1);
  return still;
}

std::string not_excited(const std::vector<int>& still) {
  if (still.empty())
    return "these motions do not tell it from the others; give a log in which every joint moves at changing "
           "speed "
           "and reverses";
  return fmt::format("joint {} never moves; give a log in which it moves and reverses",
                     fmt::join(still, ", "));
}

void list_base_parameters(const WeakFit& weak, const std::vector<int>& still, Identification& id) {
  for (int p = 0; p < id.space.count(); ++p) {
    const bool is_rigid = p<id.space.rigid(), is_width = p> id.space.timing();
    const bool is_free = id.covariance(p, p) > 0.0;
    const bool always = is_rigid || p < id.space.offset(0);
    if (!is_free && !always) continue;
    ParameterEstimate e;
    e.name = id.space.name(p);
    e.unit = id.space.unit(p);
    e.value = is_width ? std::exp(id.estimate[p]) : id.estimate[p];
    e.identifiable = is_free && (is_width || !weak.confounded[p]);
    e.std = std::sqrt(id.covariance(p, p)) * (is_width ? e.value : 1.0);
    if (!e.identifiable) e.why_not = not_excited(still);
    if (!e.identifiable) e.std = std::numeric_limits<double>::quiet_NaN();
    e.ci95 = {e.value - kNormal95 * e.std, e.value + kNormal95 * e.std};
    if (is_rigid) e.meaning = id.space.base[p].meaning;
    id.base_parameters.push_back(e);
  }
}

/// A friction offset stays where it is far from zero and the fit is clearly worse without it.
void drop_idle_offsets(const WeakFit& without, const WeakFit& with, const ParameterSpace& space,
                       std::vector<bool>& wanted) {
  for (int j = 0; j < space.joints(); ++j) {
    const int p = space.offset(j);
    const bool far = std::abs(with.parameters[p]) > 4.0 * std::sqrt(with.covariance(p, p));
    wanted[p] = wanted[p] && far && without.residual_rms[j] > kClearlyWorse * with.residual_rms[j];
  }
}

std::vector<bool> with_offsets(std::vector<bool> wanted, const ParameterSpace& space, const Robot& robot) {
  for (int j = 0; j < space.joints(); ++j)
    wanted[space.offset(j)] = robot.known.count(fmt::format("fo{}", j + 1)) == 0;
  return wanted;
}

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

/// Masses and lengths; when all lengths are settled, the chain is rebuilt on them.
void settle_physical(const WeakFit& weak, Identification& id) {
  std::vector<bool> usable;
  for (int p = 0; p < id.space.rigid(); ++p) usable.push_back(weak.free[p] && !weak.confounded[p]);
  const PhysicalFit physical = physical_parameters(id.robot, id.space, id.estimate, id.covariance, usable);
  id.physical_parameters = physical.parameters;
  if (!physical.lengths) return;
  Robot sized = id.robot;
  sized.chain.length = *physical.lengths;
  const ParameterSpace space = parameter_space(sized);
  if (space.base.size() == id.space.base.size() && !depends_on_lengths(id.space, space)) id.space = space;
}

}  // namespace

Identification identify(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                        const Progress& progress) {
  options.check();
  Identification id;
  id.robot = robot;
  id.space = parameter_space(robot);
  Gathered gathered{WeakWindows(id.space, options.window_s, options.max_windows),
                    Excerpts(options.segment_s, options.min_segment_rows, options.max_rows),
                    {}};
  gather(logs, progress, gathered, id);

  const Eigen::VectorXd nominal = parameters_of(id.space, robot.chain, nominal_timing(robot));
  std::vector<bool> wanted = wanted_parameters(id.space, robot);
  WeakFit weak = fit_weak_form(gathered.windows, nominal, wanted);
  if (options.estimate_offset && has_fast_log(id)) {
    const std::vector<bool> with = with_offsets(wanted, id.space, robot);
    const WeakFit offsets = fit_weak_form(gathered.windows, nominal, with);
    wanted = with;
    drop_idle_offsets(weak, offsets, id.space, wanted);
    weak = fit_weak_form(gathered.windows, nominal, wanted);
  }

  bool weak_is_final = options.method == IdentifyMethod::weak_form;
  if (!weak_is_final) {
    const auto excerpts = gathered.excerpts.take();
    const ShootingFit shot = fit_shooting(id.space, excerpts, weak.parameters,
                                          free_parameters(weak, id, options), priors_of(id.space, robot),
                                          first_noise(gathered.roughness), noise_floor(gathered.roughness),
                                          {options.max_iterations, 6, thread_count(options)}, progress);
    take_shooting(shot, gathered, id);
    weak_is_final = options.method == IdentifyMethod::automatic &&
                    model_error_dominates(shot, gathered.roughness.std(), noise_floor(gathered.roughness));
    if (weak_is_final) id.issues.add(model_error_issue());
  }
  if (weak_is_final) {
    if (options.estimate_width) weak = fit_weak_form_and_width(gathered.windows, nominal, wanted);
    take_weak_form(weak, gathered, id);
  }

  id.condition_number = weak.condition_number;
  judge_fit(gathered.windows, id);
  if (weak_is_final) smooth_friction(nominal, id);
  const auto still = still_joints(gathered, id.q_noise);
  list_base_parameters(weak, still, id);
  const bool all_told = std::all_of(id.base_parameters.begin(), id.base_parameters.end(),
                                    [](const ParameterEstimate& e) { return e.identifiable; });
  if (!all_told && id.status == IdentificationStatus::converged) {
    id.status = IdentificationStatus::poorly_excited;
    id.reason += "; " + not_excited(still);
  }
  settle_physical(weak, id);
  id.robot = robot_with(id.robot, id.space, id.estimate);
  return id;
}

}  // namespace faultline
