// SPDX-License-Identifier: MIT
#include "lib/log/issues/velocity_issues.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/channel_names.hpp"

namespace faultline {
namespace {

constexpr double kDegrees = 57.2958;
constexpr double kRpm = 0.104720;
constexpr double kNear = 0.1;        // relative, of a factor from the one that a unit gives
constexpr double kSameFactor = 0.1;  // relative spread of the joints' factors if they have one common cause

bool near(double factor, double value) { return std::abs(factor / value - 1.0) < kNear; }

std::string guess_of(double factor, bool turns, bool slides) {
  if (factor < 0.0) return "the sign of one of them is wrong";
  if (!slides && near(factor, kDegrees)) return "the position seems to be in degrees, the velocity in rad/s";
  if (!slides && near(factor, 1.0 / kDegrees))
    return "the velocity seems to be in deg/s, the position in rad";
  if (!slides && near(factor, kRpm)) return "the velocity seems to be in rpm, the position in rad";
  if (near(factor, 1e3))
    return turns ? "the velocity's unit is 1000 times too large, or the time is in s and was treated as ms"
                 : "the position seems to be in mm, the velocity in m/s, or the time in s and treated as ms";
  if (near(factor, 1e-3))
    return turns ? "the time seems to be in ms"
                 : "the time seems to be in ms, or the velocity in mm/s and the position in m";
  return "their units, a gear ratio or the sample period differ";
}

/// Returns the factor between positions and the integrals of velocities that all moving joints, at least two,
/// share; 1 if they share none, or if a joint agrees or contradicts.
double common_factor(const std::vector<VelocityAgreement>& agreements) {
  std::vector<double> factors;
  for (const VelocityAgreement& agreement : agreements) {
    if (agreement.verdict == VelocityVerdict::contradicts || agreement.verdict == VelocityVerdict::agrees)
      return 1.0;
    if (agreement.verdict == VelocityVerdict::scaled) factors.push_back(agreement.factor);
  }
  if (factors.size() < 2) return 1.0;
  std::sort(factors.begin(), factors.end());
  const double middle = factors[factors.size() / 2];
  if (factors.front() <= 0.0 || factors.back() > (1.0 + kSameFactor) * middle ||
      factors.front() < (1.0 - kSameFactor) * middle)
    return 1.0;
  return middle;
}

/// Whether units of angles explain a factor that all joints share, which requires that none of them slides.
bool is_of_angles(double factor, const QualityOptions& options) {
  const bool some_slide = std::count(options.slides.begin(), options.slides.end(), true) > 0;
  return !some_slide && (near(factor, kDegrees) || near(factor, 1.0 / kDegrees) || near(factor, kRpm));
}

std::string time_guess(double factor, double period_s) {
  for (const auto& [unit, si] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}})
    if (near(factor, si)) return fmt::format("the time seems to be in {}, but was treated as s", unit);
  for (const auto& [unit, si] : {std::pair{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}})
    if (near(factor, si)) return fmt::format("the time seems to be in s, but was treated as {}", unit);
  return fmt::format(
      "the sample period seems to be {:.4g} s, not {:.4g} s: multiply the scale of t by {:.4g}",
      factor * period_s, period_s, factor);
}

void judge_one(const VelocityAgreement& agreement, int joint, const std::string& why, Issues& issues) {
  const std::string channel = to_string({Quantity::dq, joint});
  if (agreement.verdict == VelocityVerdict::scaled)
    issues.add({"velocity_contradicts_position", channel, Severity::severe,
                fmt::format("the position changes {:.4g} times as fast as the velocity: {}", agreement.factor,
                            why)});
  if (agreement.verdict == VelocityVerdict::contradicts)
    issues.add({"velocity_contradicts_position", channel, Severity::warning,
                fmt::format("the velocity does not follow the position (correlation {:.2f}); one of them "
                            "belongs to another joint, or was stuck",
                            agreement.correlation)});
}

constexpr double kOneMotion = 0.98;      // least correlation of position and velocity for a meaningful factor
constexpr double kLeastOff = 0.004;      // difference of the factor from 1; healthy logs have less
constexpr double kSurelyOff = 5.0;       // the same in standard deviations
constexpr double kOneScale = 0.002;      // between factors of two joints; errors of integrals are smaller
constexpr double kScaleDoubts = 3.0;     // the same in standard deviations
constexpr double kShareAlike = 2.0 / 3;  // of the moving joints: the sensor of one may drift

}  // namespace

void judge_velocities(const std::vector<VelocityAgreement>& agreements, const TimeAxis& time,
                      const QualityOptions& options, Issues& issues) {
  const double factor = common_factor(agreements);
  const bool all_alike = factor != 1.0 && !is_of_angles(factor, options);
  if (all_alike)
    issues.add({"sample_period_contradicts_motion", "t", Severity::severe,
                fmt::format("the positions of all moving joints change {:.4g} times as fast as their "
                            "velocities: {}; correct it in the robot file: [log.columns] t",
                            factor, time_guess(factor, time.period_s))});
  for (std::size_t j = 0; j < agreements.size(); ++j) {
    const bool known = j < options.slides.size();
    const int joint = static_cast<int>(j) + 1;
    const std::string guess =
        guess_of(agreements[j].factor, known && !options.slides[j], known && options.slides[j]);
    const std::string why = all_alike ? "so do those of all moving joints, see the sample period"
                                      : guess + "; correct it in the robot file: [log.columns] " +
                                            to_string({Quantity::dq, joint});
    judge_one(agreements[j], joint, why, issues);
  }
}

void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues) {
  std::vector<VelocityAgreement> moving;
  std::vector<double> factors;
  for (const VelocityAgreement& joint : agreements)
    if (joint.verdict == VelocityVerdict::agrees && joint.correlation > kOneMotion) {
      moving.push_back(joint);
      factors.push_back(joint.factor);
    }
  if (moving.size() < 2) return;
  const double factor = upper_median(factors);
  double least_std = std::numeric_limits<double>::infinity();
  int alike = 0;
  for (const VelocityAgreement& joint : moving) {
    if (std::abs(joint.factor - factor) > std::max(kScaleDoubts * joint.factor_std, kOneScale)) continue;
    least_std = std::min(least_std, joint.factor_std);
    ++alike;
  }
  const auto enough = std::max(2.0, kShareAlike * static_cast<double>(moving.size()));
  if (alike < enough || std::abs(factor - 1.0) < std::max(kLeastOff, kSurelyOff * least_std)) return;
  issues.add(make_issue(kScaledMotion, Severity::warning,
                        fmt::format("the positions of {} of {} moving joints change {:.4f} times as fast as "
                                    "their velocities: the clock or the positions are scaled. If the clock "
                                    "is scaled, correct it in the robot file, [log.columns] t = {{scale = "
                                    "{:.4f}}}; if the positions are, use {{scale = {:.4f}}} for each of them",
                                    alike, moving.size(), factor, factor, 1.0 / factor)));
}

}  // namespace faultline
