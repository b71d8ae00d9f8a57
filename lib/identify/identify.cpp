// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "lib/core/error.hpp"
#include "lib/identify/excerpt.hpp"
#include "lib/identify/shooting.hpp"
#include "lib/identify/stretch.hpp"
#include "lib/identify/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kWidthDoubt = 1.15;    ///< of ln(width): a factor of about 3
constexpr double kShowsWidth_s = 0.03;  ///< slower logs step over the velocities where friction bends
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

std::vector<int> free_parameters(const WeakFit& weak, const Identification& id,
                                 const IdentifyOptions& options) {
  const ParameterSpace& space = id.space;
  const bool is_fast = std::any_of(id.logs.begin(), id.logs.end(), [](const IdentifiedLog& log) {
    return log.sample_period_s < kShowsWidth_s;
  });
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

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void list_base_parameters(const WeakFit& weak, Identification& id) {
  for (int p = 0; p < id.space.count(); ++p) {
    ParameterEstimate e;
    e.name = id.space.name(p);
    e.unit = id.space.unit(p);
    const bool is_width = p > id.space.timing();
    e.value = is_width ? std::exp(id.estimate[p]) : id.estimate[p];
    e.std = std::sqrt(id.covariance(p, p)) * (is_width ? e.value : 1.0);
    e.ci95 = {e.value - kNormal95 * e.std, e.value + kNormal95 * e.std};
    e.identifiable = e.std > 0.0 && (is_width || !weak.confounded[p]);
    if (p < id.space.rigid()) e.meaning = id.space.base[p].meaning;
    id.base_parameters.push_back(e);
  }
}

}  // namespace

Identification identify(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                        const Progress& progress) {
  options.check();
  Identification id;
  id.space = parameter_space(robot);
  Gathered gathered{WeakWindows(id.space, options.window_s, options.max_windows),
                    Excerpts(options.segment_s, options.min_segment_rows, options.max_rows),
                    {}};
  gather(logs, progress, gathered, id);

  const Eigen::VectorXd nominal = parameters_of(id.space, robot.chain, nominal_timing(robot));
  const WeakFit weak = fit_weak_form(gathered.windows, nominal, wanted_parameters(id.space, robot));
  const auto excerpts = gathered.excerpts.take();
  const ShootingFit shot = fit_shooting(id.space, excerpts, weak.parameters,
                                        free_parameters(weak, id, options), priors_of(id.space, robot),
                                        first_noise(gathered.roughness), noise_floor(gathered.roughness),
                                        {options.max_iterations, 6, thread_count(options)}, progress);

  id.method = IdentifyMethod::output_error;
  id.status = shot.converged ? IdentificationStatus::converged : IdentificationStatus::not_converged;
  id.reason = shot.reason;
  id.estimate = shot.parameters;
  id.covariance = shot.covariance;
  id.q_noise = list(shot.noise.head(robot.joints()));
  if (gathered.roughness.has_dq()) id.dq_noise = list(shot.noise.tail(robot.joints()));
  id.condition_number = weak.condition_number;
  id.residual_rms = weak.residual_rms;
  id.fit_r2 = weak.r2;
  id.robot = robot_with(robot, id.space, id.estimate);
  list_base_parameters(weak, id);
  return id;
}

}  // namespace faultline
