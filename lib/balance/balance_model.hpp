// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "lib/balance/noise.hpp"
#include "lib/balance/row_setting.hpp"

namespace faultline {

/// Prior variance of an effect of the day that the model does not use because it looks like another one: gain
/// and offset of a joint that carries weight.
inline constexpr double kNoEffect = 1e-10;

/// Model that explains a log by torque-balance rows (equation (2) of docs/how-it-works.md): the robot, its
/// normal variation between days, and the noise of the rows.
struct BalanceModel {
  RowSetting setting;
  RigidColumns rigid;
  Eigen::MatrixXd payload;       ///< base parameters x links: change by 1 kg at the end of a link
  Eigen::VectorXd theta;         ///< see ColumnLayout
  Eigen::VectorXd day_variance;  ///< prior variance of the effects of a day, see DayLayout
  int ripples_of_day = 0;  ///< the last ripples of `setting`: not learned, effects of the day of one log
  RowNoise noise;
  bool torque_is_measured = false;  ///< behind the drive, so that a loss of torque does not show
  double piece_kg = 0.0;            ///< mass of a work piece that comes and goes at the tip; 0: there is none

  // Statistics of the healthy logs, by joint.
  Eigen::VectorXd q_noise, dq_noise;         ///< white noise of one sample
  Eigen::VectorXd q_low, q_high, top_speed;  ///< range, and the speed that 1 in 1000 rows exceeds
  Eigen::VectorXd torque_rms;
  /// Bound of the residual torque of a joint that rests, N m or N, if static friction holds it: its torque is
  /// any within this bound. 0 if friction by speed explains the joint at rest, too.
  Eigen::VectorXd stiction;
  /// Largest torque of each drive, N m or N: a command beyond it does not arrive. 0 if no limit is known.
  Eigen::VectorXd drive_limit;
  Eigen::VectorXi longest_repeat;  ///< longest run of samples that repeat the position before
  Eigen::VectorXd repeat_share;    ///< share of samples that repeat the position before

  int joints() const { return setting.joints(); }
  ColumnLayout layout() const { return layout_of(rigid, setting); }
  /// Compliance of the gear spring of joint `j` (from 0), rad per N m or m per N; 0: rigid.
  double compliance(int j) const { return std::max(theta[layout().spring(j)], 0.0); }
};

/// Indices of the effects of a day (equation (2) of docs/how-it-works.md): relative change of each base
/// parameter; then, for each joint, relative friction, its relative slope over the log, gain and offset of
/// the torque, relative width of the friction's step at rest, relative excess of viscous over dry friction
/// (see viscous_part), relative difference of dry friction by direction, friction by load as a share of the
/// torque that is carried; then the delay of all torques, samples; then relative friction of each coupled
/// drive; then sine and cosine of each ripple of the day, N m or N.
struct DayLayout {
  int base = 0, joints = 0, drives = 0, ripples = 0;

  int inertia(int parameter) const { return parameter; }
  int friction(int j) const { return base + j; }
  int friction_slope(int j) const { return base + joints + j; }
  int gain(int j) const { return base + 2 * joints + j; }
  int offset(int j) const { return base + 3 * joints + j; }
  int friction_width(int j) const { return base + 4 * joints + j; }
  int viscous_excess(int j) const { return base + 5 * joints + j; }
  int direction(int j) const { return base + 6 * joints + j; }
  int load(int j) const { return base + 7 * joints + j; }
  int delay() const { return base + 8 * joints; }
  int drive_friction(int k) const { return delay() + 1 + k; }
  int ripple(int k) const { return drive_friction(drives) + 2 * k; }
  int count() const { return ripple(ripples); }
};

/// Returns the viscous part of a joint's friction at half its top speed, from 0 to 1. On a day whose viscous
/// friction exceeds its dry friction by the share d, viscous friction is (1 - part) d more and dry friction
/// part d less than the usual one, so that their sum at that speed is that of the usual day.
double viscous_part(double viscous, double dry, double top_speed);

inline DayLayout day_layout(const BalanceModel& m) {
  return {m.rigid.base(), m.joints(), static_cast<int>(m.setting.drives.size()), m.ripples_of_day};
}

/// Returns the columns of the effects of a day, by joint: rows x effects.
std::vector<Eigen::MatrixXd> day_columns(const BalanceRows& rows, const BalanceModel& model);

/// Returns the torque of the robot `theta` in each row: rows x joints, N m or N.
Eigen::MatrixXd torque_of(const BalanceRows& rows, const Eigen::VectorXd& theta);

/// Returns the torque of 1 kg at the end of link `link` (from 0) in each row: rows x joints, N m or N.
Eigen::MatrixXd payload_torque(const BalanceRows& rows, const Eigen::MatrixXd& payload, int link);

/// Returns whether a base parameter is the inertia of a rotor, without any part of a link.
bool is_rotor(const RigidColumns& rigid, int parameter);

/// Returns whether gain and offset of a joint's torque look like a mass: a slide along gravity.
bool carries_weight(const RigidColumns& rigid, int j);

}  // namespace faultline
