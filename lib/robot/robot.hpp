// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/log/channels.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// How a link's mass is distributed, which decides how its mass and length determine its inertia.
enum class LinkShape {
  rod,      ///< uniform thin rod along the link (the paper's links 1 and 2)
  point,    ///< at the joint's origin (the paper's link 3)
  general,  ///< mass, centre and inertia are free
};

/// A value that the user states in the robot file; std 0 means exact.
struct KnownValue {
  double value = 0.0;
  double std = 0.0;
};

enum class TorqueMeaning { commanded, measured, current };
/// Course of the torque between two samples of the log.
enum class TorqueTiming { held, linear, unknown };

/// Meaning of the columns of this robot's logs ([log] of the robot file).
struct LogMeaning {
  TorqueMeaning torque = TorqueMeaning::commanded;
  TorqueTiming torque_between_samples = TorqueTiming::unknown;
  ColumnMap columns;
  RecordingChoice recording{};
  /// C of drives that move more than one joint, n x n and regular: q = C q_logged (see coupled()); 0 x 0 if
  /// each drive moves its own joint only.
  Eigen::MatrixXd coupling;
};

/// A robot as its file describes it: geometry and the known or identified parameters.
struct Robot {
  std::string name;
  std::string axes;  ///< parallel axes such as "RRP", base to tip; "" for a chain given axis by axis
  Chain chain;
  std::vector<LinkShape> shapes;
  /// Facts by parameter name, joints from 1: m1.. (kg), l1.. (m), fv1.., fc1.., fo1.., fb1.., fs1.., fl1..
  /// (viscous, Coulomb, offset, bend, skew and load of Friction), jr1.. (rotor inertia seen at the joint).
  /// They are also set in `chain`.
  std::map<std::string, KnownValue> known;
  /// Known mass carried at the tip (kg) during single logs, by the log's file name without folders.
  std::map<std::string, KnownValue> payloads;
  /// True if every parameter of `chain` has been identified or was given; false for nominal values.
  bool identified = false;
  /// Identified timing of the torque: over a sample it was tau_k + phi (tau_k+1 - tau_k). 0 is held.
  std::optional<double> torque_phi;
  /// Identified for each joint: delay from the logged torque to its action, s; a whole number of samples of
  /// the logs of the identification. Empty if there is no delay.
  std::vector<double> torque_delay_s;
  /// Identified for each joint: ratio of true to logged torque, beside the units of the columns. Empty if all
  /// are 1.
  std::vector<double> torque_gain;
  /// Identified for each joint: largest torque of its drive, N m or N, in the unit of the torque with its
  /// gain; a command beyond it does not arrive. 0: no limit is known. Empty if none is.
  std::vector<double> torque_limit;
  /// Identified for each joint: compliance of the gear between drive and link, rad/(N m) or m/N. Empty if all
  /// gears are rigid. The equations of motion of this library assume rigid gears.
  std::vector<double> gear_compliance;
  LogMeaning log;
  NormalRange normal;
  LeastSizes least_sizes;

  int joints() const { return chain.joints(); }
};

/// Whether the text is 1 to kMaxJoints letters R and P.
bool is_order_of_axes(const std::string& text);

/// Returns a robot with parallel axes in any order, base to tip, such as "RRP", "RPRR" or "R": R turns about
/// z, P slides along z. An R link reaches along x to the next joint; a P link carries the next joint on its
/// own line. R links are rods, P links points; a last R directly after P, with two or more R before it, is a
/// tool's wrist of general shape. Lengths 1 m, masses 1 kg, no friction, gravity along -z; to move the arm in
/// a vertical plane, set a gravity within that plane. Throws Error(usage) if the text is no order of axes.
Robot preset_robot(const std::string& axes);

/// Unit vector along link i in its own frame: towards the next joint, or along x if the link has no
/// direction.
Eigen::Vector3d link_direction(const Robot& robot, int i);

/// Returns the robot with a tip (m, in the last link's frame at q = 0). Its joints are placed by offsets
/// alone, all lengths 0. A chain can hold a tip only beyond a revolute last joint and, if that is the only
/// joint, along x; any other tip is ignored: it stays at the last joint.
Robot with_tip(Robot robot, const Eigen::Vector3d& tip);

/// Returns the robot with links of these masses (kg) and lengths (m), one for each joint; the bodies of
/// general shape stay.
Robot with_masses_and_lengths(Robot robot, const std::vector<double>& masses,
                              const std::vector<double>& lengths);

const char* to_string(AxisKind kind);
const char* to_string(LinkShape shape);
const char* to_string(TorqueMeaning meaning);
/// Origin of a logged torque in words for legends: "commanded", "measured", "from motor current".
const char* logged_words(TorqueMeaning meaning);
const char* to_string(TorqueTiming timing);

/// Returns the course of the torque between two samples of this robot's logs: as the robot file states it or,
/// where it does not, the nearer one to the identified timing; unknown without either.
TorqueTiming torque_between_samples(const Robot& robot);

/// Names of the parameters that a robot file may state: m1.., l1.., fv1.. and so on (see Robot::known).
std::vector<std::string> parameter_names(int joints);

/// Sets the parameter `name` in `robot.chain` without adding it to `robot.known`. The mass of a general link
/// scales its whole inertia. Returns false if the robot has no such parameter.
bool set_parameter(Robot& robot, const std::string& name, double value);

}  // namespace faultline
