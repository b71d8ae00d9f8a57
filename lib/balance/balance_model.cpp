// SPDX-License-Identifier: MIT
#include "lib/balance/balance_model.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "lib/balance/regressor.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kAlong = 0.9;  // least cosine between gravity and a slide, or a revolute axis before it

/// Returns the derivative of tanh(speed / width) by ln(width).
Eigen::VectorXd by_width(const Eigen::VectorXd& speed, double width) {
  return speed.unaryExpr([width](double v) {
    const double saturated = elementary::tanh(v / width);
    return -v / width * (1.0 - saturated * saturated);
  });
}

/// Returns tanh^2(speed / width): 1 in either direction, 0 at rest.
Eigen::VectorXd either_direction(const Eigen::VectorXd& speed, double width) {
  return speed.unaryExpr([width](double v) { return Eigen::numext::abs2(elementary::tanh(v / width)); });
}

}  // namespace

double viscous_part(double viscous, double dry, double top_speed) {
  const double moving = std::max(viscous, 0.0) * 0.5 * top_speed, resting = std::max(dry, 0.0);
  return moving > 0.0 ? moving / (moving + resting) : 0.0;
}

std::vector<Eigen::MatrixXd> day_columns(const BalanceRows& rows, const BalanceModel& model) {
  const ColumnLayout layout = model.layout();
  const Eigen::VectorXd& theta = model.theta;
  const DayLayout day = day_layout(model);
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(rows.rows(), -1.0, 1.0);
  std::vector<Eigen::MatrixXd> out(layout.joints, Eigen::MatrixXd::Zero(rows.rows(), day.count()));
  for (int j = 0; j < layout.joints; ++j) {
    const Eigen::MatrixXd& column = rows.column[j];
    out[j].leftCols(layout.base) = column.leftCols(layout.base) * theta.head(layout.base).asDiagonal();
    const Eigen::VectorXd viscous = column.col(layout.viscous(j)) * theta[layout.viscous(j)];
    const Eigen::VectorXd friction = viscous + column.col(layout.coulomb(j)) * theta[layout.coulomb(j)] +
                                     column.col(layout.load(j)) * theta[layout.load(j)];
    out[j].col(day.friction(j)) = friction;
    out[j].col(day.viscous_excess(j)) =
        viscous -
        viscous_part(theta[layout.viscous(j)], theta[layout.coulomb(j)], model.top_speed[j]) * friction;
    out[j].col(day.friction_slope(j)) = friction.cwiseProduct(time);
    out[j].col(day.gain(j)) = column.leftCols(layout.delay(0)) * theta.head(layout.delay(0));
    for (int d = 0; d < day.drives; ++d)
      out[j].col(day.drive_friction(d)) =
          column.middleCols<2>(layout.drive(d) + 1) * theta.segment<2>(layout.drive(d) + 1);
    out[j].col(day.offset(j)).setOnes();
    out[j].col(day.load(j)) = column.col(layout.load(j));
    out[j].col(day.delay()) = column.col(layout.delay(j));
    out[j].col(day.direction(j)) =
        theta[layout.coulomb(j)] * either_direction(rows.dq.col(j), model.setting.friction_width[j]);
    out[j].col(day.friction_width(j)) =
        theta[layout.coulomb(j)] * by_width(rows.dq.col(j), model.setting.friction_width[j]);
  }
  const int learned = layout.ripples - day.ripples;
  for (int r = 0; r < day.ripples; ++r) {
    const int j = model.setting.ripples[learned + r].joint.index();
    out[j].middleCols<2>(day.ripple(r)) = rows.column[j].middleCols<2>(layout.ripple_sine(learned + r));
  }
  return out;
}

Eigen::MatrixXd torque_of(const BalanceRows& rows, const Eigen::VectorXd& theta) {
  Eigen::MatrixXd out(rows.rows(), rows.joints());
  for (int j = 0; j < rows.joints(); ++j) out.col(j) = rows.column[j] * theta;
  return out;
}

Eigen::MatrixXd payload_torque(const BalanceRows& rows, const Eigen::MatrixXd& payload, int link) {
  Eigen::MatrixXd out(rows.rows(), rows.joints());
  for (int j = 0; j < rows.joints(); ++j)
    out.col(j) = rows.column[j].leftCols(payload.rows()) * payload.col(link);
  return out;
}

bool is_rotor(const RigidColumns& rigid, int parameter) {
  return rigid.lift.col(parameter).head(rigid.joints() * kLinkParameters).isZero(0.0);
}

bool carries_weight(const RigidColumns& rigid, int j) {
  const JointGeometry& axis = rigid.chain.geometry[j];
  const double g = rigid.chain.gravity.norm();
  if (axis.kind != AxisKind::prismatic || g == 0.0) return false;
  for (int i = 0; i < j; ++i)  // if a joint tilts the slide, weight and offset differ
    if (rigid.chain.geometry[i].kind == AxisKind::revolute &&
        std::abs(rigid.chain.geometry[i].axis.dot(rigid.chain.gravity)) < kAlong * g)
      return false;
  return std::abs(axis.axis.dot(rigid.chain.gravity)) > kAlong * g;
}

}  // namespace faultline
