// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {

/// A value that is compared with those of its kind.
struct TwinMember {
  std::string name;  ///< robot, or robot and pair of joints
  double value = 0.0;
  double std = 0.0;
};

/// A member that differs from the others more than they differ from each other.
struct TwinOutlier {
  std::size_t member = 0;
  double difference = 0.0;  ///< from the mean of the others
  double spread = 0.0;      ///< standard deviation of the others
  double p = 1.0;           ///< bound of the probability of such a member among equals
};

struct TwinComparison {
  std::string what, unit;  ///< "friction of joint 1", or "friction, first joint of a pair minus the second"
  std::vector<TwinMember> members;
  std::vector<TwinOutlier> outliers;  ///< beyond chance
};

/// Comparisons of one kind, or why there are none.
struct TwinReport {
  std::string not_applicable;  ///< a sentence; empty if there are comparisons
  std::vector<TwinComparison> comparisons;
};

using JointPair = std::array<Joint, 2>;

/// Fewest members of a comparison: the spread of the others needs three of them.
inline constexpr std::size_t kFewestTwins = 4;
/// Probability that a member stands out in any comparison of a report if all are equal.
inline constexpr double kTwinFalseAlarms = 0.01;

/// Returns the members that stand out. Each is compared with the mean of the others by Student's t with their
/// standard deviation, which is at least that of the members' own uncertainty; the rate of false alarms is
/// shared by the members.
std::vector<TwinOutlier> twin_outliers(const std::vector<TwinMember>& members, double false_alarms);

/// Compares each item of the condition between robots: its mean since the last change.
TwinReport compare_robots(const std::vector<RobotWear>& robots);
/// Compares the differences between the joints of pairs, over all robots and pairs: those of friction and
/// drive torque, which are shares and therefore comparable between joints of different size.
TwinReport compare_joints(const std::vector<RobotWear>& robots, const std::vector<JointPair>& pairs);

/// Parses "1:4,2:5"; empty for an empty text. Throws Error(usage) with `option`.
std::vector<JointPair> joint_pairs(const std::string& text, const std::string& option);

/// Returns "friction of joint 1: line3 is +18 % beside the mean of the 5 others, which scatter by 4 %".
std::string outlier_words(const TwinComparison& comparison, const TwinOutlier& outlier);
/// A line for each member that stands out, for a terminal.
std::string to_text(const TwinReport& report);
nlohmann::ordered_json to_json(const TwinReport& report);
/// A list for a page, or a sentence why there is none or that nothing stands out.
std::string twins_html(const TwinReport& report);

}  // namespace faultline
