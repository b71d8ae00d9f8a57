// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/identify/excitation/suggest_motion.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/toml/toml_text.hpp"

namespace faultline {
namespace {

std::string list(const std::vector<double>& values) {
  return toml_numbers(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

std::string comments(const SuggestedMotion& motion) {
  std::string text = fmt::format(
      "# A motion that determines the parameters: condition number {:.3g}, that of the logs was {:.3g}.\n"
      "# Check before a robot runs it: the work space must be free and the drives strong enough.\n",
      motion.condition, motion.condition_of_logs);
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
    text += fmt::format(
        "#   joint {}: at most {:.3g} {}, {:.3g} {}{}\n", j + 1, motion.joints[j].fastest,
        velocity_unit(motion.joints[j].kind), motion.joints[j].torque, torque_unit(motion.joints[j].kind),
        motion.joints[j].beyond_logs ? "; farther or faster than in the logs, which hardly move this joint"
                                     : "");
  return text;
}

}  // namespace

std::string suggestion_text(const SuggestedMotion& motion, const std::string& robot_file) {
  const SimulationSpec& s = motion.simulation;
  std::string text = comments(motion);
  text += fmt::format(
      "robot = {}\nduration_s = {}\nsample_period_s = {}\ncontrol_period_s = \"held\"\nmax_step_s = {}\n",
      toml_quoted(robot_file), toml_number(s.duration_s), toml_number(s.sample_period_s),
      toml_number(s.max_step_s));
  text += fmt::format(
      "record_reference = true\n\n[motion]\nprofile = \"fourier\"\nlow = {}\nhigh = {}\nharmonics = {}\n"
      "fourier_period_s = {}\n\n[noise]\nq = {}\n",
      list(s.motion.low), list(s.motion.high), s.motion.harmonics, toml_number(s.motion.fourier_period_s),
      list(s.noise.q));
  if (!s.noise.dq.empty()) text += fmt::format("dq = {}\n", list(s.noise.dq));
  return text + fmt::format("\n[[run]]\nname = \"suggested\"\nseed = {}\n", motion.seed);
}

}  // namespace faultline
