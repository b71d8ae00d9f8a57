// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/identify/stretch.hpp"
#include "lib/identify/weak_form.hpp"

namespace faultline {
namespace {

constexpr double kWidthGuess = 0.01;

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

Identification identify(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                        const Progress& progress) {
  options.check();
  Identification id;
  id.robot = robot;
  id.space = parameter_space(robot);
  WeakWindows windows(id.space, options.window_s, options.max_windows);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress("reading", static_cast<double>(i) / static_cast<double>(logs.size()));
    const auto read = for_each_stretch(*logs[i], static_cast<int>(i), robot.joints(),
                                       [&](const Stretch& s) { windows.add(s); });
    const LogIdentity& from = logs[i]->identity();
    id.logs.push_back(
        {from.path, from.sha256, read.rows, windows.rows_used(static_cast<int>(i)), read.period_s, 0.0});
    id.issues.merge(logs[i]->issues());
  }
  if (windows.all().size() < 10)
    throw Error(
        ErrorCode::input, logs.empty() ? "" : logs[0]->identity().path,
        fmt::format("gives {} usable windows in all; identification needs at least 10: give longer logs of a "
                    "moving robot",
                    windows.all().size()));
  const Eigen::VectorXd start = parameters_of(id.space, robot.chain, nominal_timing(robot));
  const WeakFit fit = fit_weak_form(windows, start, wanted_parameters(id.space, robot));
  id.method = IdentifyMethod::weak_form;
  id.status = IdentificationStatus::converged;
  id.estimate = fit.parameters;
  id.covariance = fit.covariance;
  id.condition_number = fit.condition_number;
  id.residual_rms = fit.residual_rms;
  id.fit_r2 = fit.r2;
  id.robot = robot_with(robot, id.space, id.estimate);
  for (int p = 0; p < id.space.linear(); ++p) {
    ParameterEstimate e;
    e.name = id.space.name(p);
    e.unit = id.space.unit(p);
    e.value = id.estimate[p];
    e.std = std::sqrt(id.covariance(p, p));
    e.ci95 = {e.value - 1.96 * e.std, e.value + 1.96 * e.std};
    e.identifiable = fit.free[p] && !fit.confounded[p];
    id.base_parameters.push_back(e);
  }
  return id;
}

}  // namespace faultline
