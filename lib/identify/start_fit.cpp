// SPDX-License-Identifier: MIT
#include "lib/identify/start_fit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace faultline {
namespace {

constexpr double kClearlyWorse = 1.05;  ///< residual without an offset against that with it

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
    wanted[space.offset(j)] = wanted[space.coulomb(j)] && robot.known.count(fmt::format("fo{}", j + 1)) == 0;
  return wanted;
}

}  // namespace

std::vector<bool> wanted_parameters(const ParameterSpace& space, const Robot& robot,
                                    const std::vector<int>& still) {
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
  for (int joint : still) wanted[space.viscous(joint - 1)] = wanted[space.coulomb(joint - 1)] = false;
  wanted[space.timing()] = robot.log.torque_between_samples == TorqueTiming::unknown;
  return wanted;
}

WeakFit start_fit(const WeakWindows& windows, const Eigen::VectorXd& nominal, bool try_offsets,
                  const Robot& robot, std::vector<bool>& wanted) {
  const WeakFit without = fit_weak_form(windows, nominal, wanted);
  if (!try_offsets) return without;
  const WeakFit with = fit_weak_form(windows, nominal, with_offsets(wanted, windows.space(), robot));
  wanted = with_offsets(wanted, windows.space(), robot);
  drop_idle_offsets(without, with, windows.space(), wanted);
  return fit_weak_form(windows, nominal, wanted);
}

}  // namespace faultline
