// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lib/log/channels.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/least_sizes.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// How a link's mass is distributed, which decides what its mass and length say about its inertia.
enum class LinkShape {
  rod,      ///< uniform thin rod along the link (the paper's links 1 and 2)
  point,    ///< on the joint's origin (the paper's link 3)
  general,  ///< mass, centre and inertia are free
};

/// A fact the user states in the robot file; std 0 means exact.
struct KnownValue {
  double value = 0.0;
  double std = 0.0;
};

enum class TorqueMeaning { commanded, measured, current };
/// What the torque did between two samples of the log.
enum class TorqueTiming { held, linear, unknown };

/// What the columns of this robot's logs mean ([log] of the robot file).
struct LogMeaning {
  TorqueMeaning torque = TorqueMeaning::commanded;
  TorqueTiming torque_between_samples = TorqueTiming::unknown;
  ColumnMap columns;
  RecordingChoice recording{};
  /// C of drives that move more than one joint, n x n and regular: q = C q_logged (see coupled()); 0 x 0 when
  /// each drive moves its own joint.
  Eigen::MatrixXd coupling;
};

/// A robot as its file describes it: geometry and whatever of its parameters is known so far.
struct Robot {
  std::string name;
  std::string axes;  ///< parallel axes such as "RRP", base to tip; "" for a chain given axis by axis
  Chain chain;
  std::vector<LinkShape> shapes;
  /// Facts by parameter name, joints from 1: m1.. (kg), l1.. (m), fv1.. and fc1.. (viscous and Coulomb
  /// friction), fo1.. (friction offset), fl1.. (friction's share of the load), jr1.. (rotor inertia seen at
  /// the joint). They are also set in `chain`.
  std::map<std::string, KnownValue> known;
  /// Known mass carried at the tip (kg) during single logs, by the log's file name without folders.
  std::map<std::string, KnownValue> payloads;
  /// True when every parameter of `chain` has been identified or was given; false for nominal values.
  bool identified = false;
  /// Identified timing of the torque: over a sample it was tau_k + phi (tau_k+1 - tau_k). 0 is held.
  std::optional<double> torque_phi;
  /// Identified, by joint: how much later the torque acts than it is logged, in whole samples of the logs it
  /// was identified from; s. Empty when all act when they are logged.
  std::vector<double> torque_delay_s;
  /// Identified, by joint: true torque of each one logged, beside the units of the columns. Empty when all 1.
  std::vector<double> torque_gain;
  /// Identified, by joint: how far its gear gives way between drive and link, rad/(N m) or m/N. Empty when
  /// all are rigid. The equations of motion here are those of rigid gears.
  std::vector<double> gear_compliance;
  LogMeaning log;
  NormalRange normal;
  LeastSizes least_sizes;

  int joints() const { return chain.joints(); }
};

/// Whether the text is 1 to kMaxJoints letters R and P.
bool is_order_of_axes(const std::string& text);

/// Parallel axes in any order, base to tip, such as "RRP", "RPRR" or "R": R turns about z, P slides along z.
/// An R link reaches along x to the next joint, a P link carries the next joint on its own line. R links are
/// rods, P links points; a last R right behind P, with two or more R before it, is a tool's wrist of general
/// shape. Lengths 1 m, masses 1 kg, no friction, gravity along -z; the arm moves in a vertical plane when the
/// gravity given lies in that plane. Throws Error(usage) when the text is no order of axes.
Robot preset_robot(const std::string& axes);

/// Unit vector along link i in its own frame: towards the next joint, or along x for a link that says
/// nothing.
Eigen::Vector3d link_direction(const Robot& robot, int i);

/// Puts the tip at `tip` (m, in the last link's frame at q = 0) of a chain whose joints sit by their offsets
/// alone, all lengths 0. A chain tells only of tips beyond a last joint that turns and, with a single joint,
/// along x; any other leaves the tip on the last joint.
void set_tip(Robot& robot, const Eigen::Vector3d& tip);

/// Sets the links of `robot` whose shape is rod or point from masses (kg) and lengths (m), one each a joint.
void set_masses_and_lengths(Robot& robot, const std::vector<double>& masses,
                            const std::vector<double>& lengths);

}  // namespace faultline
