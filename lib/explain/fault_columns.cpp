// SPDX-License-Identifier: MIT
#include "lib/explain/fault_columns.hpp"

#include <algorithm>
#include <numbers>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/hypothesis.hpp"
#include "lib/robot/payload.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Times before and after a jump of the position in which it changes velocities that the controller computes
/// from it, by a difference and a filter.
constexpr double kVelocityBefore_s = 0.02, kVelocityAfter_s = 0.1;
constexpr double kReach = 1.5, kReachOfJump = 4.0;  // kernels beside onset and end in which rows are silent
constexpr double kLongestReach_s = 0.1;    // s: longest reach of the jump of a stuck encoder in the velocity
constexpr double kShowsInVelocity = 0.01;  // share of a jump of the velocity, below which it has no effect
constexpr double kEdgeKernels = 4.0;       // kernels on either side of an onset or end: rows that it reaches
constexpr double kLossVariance = 0.25;     // of the share of the torque: a standard deviation of one half
constexpr double kFrictionVariance = 9.0;  // of the joint's own friction, squared
constexpr double kCreepVariance = 0.01;    // the same, per second
constexpr double kPayloadVariance = 0.36;  // of the mass that the link carries, squared
constexpr double kUnfelt = 1e-9;           // share of the greatest squared torque: less is rounding
constexpr double kOffsetVariance = 0.36;   // of the joint's usual torque, squared
constexpr double kLeastVariance = 1e-6;    // (N m s)^2 or (N m)^2: friction may rise if the model has none

/// Returns the mass at the end of a link, kg, that explains the torque of its joint best, or of the last
/// joint before that it loads. `unit`: torque of 1 kg there, rows x joints.
double carried_mass(const BalanceRows& rows, const BalanceModel& model, const MatrixXd& unit, int link) {
  const VectorXd square = unit.colwise().squaredNorm().transpose();
  for (int j = link; j >= 0; --j)
    if (square[j] > kUnfelt * square.maxCoeff())
      return std::abs((rows.column[j] * model.theta).dot(unit.col(j)) / square[j]);
  return 1.0;
}

LinearFault torque_loss(const BalanceRows& rows, const BalanceModel& m, int j) {
  LinearFault out{
      FaultKind::torque_loss,
      Joint::at(j),
      {StackedColumns::Zero(rows.rows() * rows.joints(), 1), VectorXd::Constant(1, kLossVariance)},
      {}};
  const ColumnLayout at = m.layout();
  auto lost = out.columns.column.col(0);
  lost.segment(j * rows.rows(), rows.rows()) =
      rows.torque.col(j) - m.theta[at.delay(j)] * rows.column[j].col(at.delay(j));
  // A lost torque deflects no gear spring either.
  const int spring = at.spring(j);
  for (int i = 0; i < rows.joints() && m.theta[spring] != 0.0; ++i)
    lost.segment(i * rows.rows(), rows.rows()) -= m.theta[spring] * rows.column[i].col(spring);
  if (m.piece_kg > 0.0 && carries_weight(m.rigid, j))
    for (const double size : {.4, .7, 1.}) out.starts.push_back(VectorXd::Constant(1, size));
  return out;
}

/// Returns friction that is added at once, or that creeps.
LinearFault friction_increase(const BalanceRows& rows, const BalanceModel& m, int j, bool creeps) {
  const ColumnLayout layout = m.layout();
  const double fv = m.theta[layout.viscous(j)], fc = m.theta[layout.coulomb(j)];
  LinearFault out{FaultKind::friction_increase,
                  Joint::at(j),
                  {StackedColumns::Zero(rows.rows() * rows.joints(), 2), VectorXd(2), creeps},
                  {}};
  out.columns.column.col(0).segment(j * rows.rows(), rows.rows()) = rows.column[j].col(layout.viscous(j));
  out.columns.column.col(1).segment(j * rows.rows(), rows.rows()) = rows.column[j].col(layout.coulomb(j));
  out.columns.variance << fv * fv, fc * fc;
  out.columns.variance *= creeps ? kCreepVariance : kFrictionVariance;
  out.columns.variance.array() += kLeastVariance;
  if (m.piece_kg > 0.0 && carries_weight(m.rigid, j) && !creeps) {
    out.starts.push_back(Eigen::Vector2d(fv, 1.5 * fc));
    out.starts.push_back(Eigen::Vector2d(2.0 * fv, 3.0 * fc));
  }
  return out;
}

/// Returns the offset of a torque sensor, by which the drive gives another torque than the logged one.
LinearFault torque_offset(const BalanceRows& rows, const BalanceModel& m, int j) {
  LinearFault out{FaultKind::torque_sensor_error,
                  Joint::at(j),
                  {StackedColumns::Zero(rows.rows() * rows.joints(), 1),
                   VectorXd::Constant(1, kOffsetVariance * m.torque_rms[j] * m.torque_rms[j])},
                  {}};
  out.columns.column.col(0).segment(j * rows.rows(), rows.rows()).setOnes();
  if (m.piece_kg > 0.0 && carries_weight(m.rigid, j)) out.starts.push_back(VectorXd::Zero(1));
  return out;
}

LinearFault payload_change(const BalanceRows& rows, const BalanceModel& m, Joint link) {
  const MatrixXd unit = payload_torque(rows, m.payload, link.index());
  const double mass = carried_mass(rows, m, unit, link.index());
  LinearFault out{FaultKind::payload_change,
                  link,
                  {Eigen::Map<const VectorXd>(unit.data(), unit.size()),
                   VectorXd::Constant(1, kPayloadVariance * mass * mass)},
                  {},
                  mass};
  if (m.piece_kg > 0.0 && link == Joint::at(rows.joints() - 1))
    for (const double share : {.25, .6, 1.}) out.starts.push_back(VectorXd::Constant(1, share * mass));
  return out;
}

}  // namespace

std::vector<LinearFault> linear_faults(const BalanceRows& rows, const BalanceModel& m) {
  const int n = rows.joints();
  std::vector<LinearFault> out;
  for (int j = 0; j < n && !m.torque_is_measured; ++j) out.push_back(torque_loss(rows, m, j));
  for (int j = 0; j < n; ++j) out.push_back(torque_offset(rows, m, j));
  for (const bool creeps : {false, true})
    for (int j = 0; j < n; ++j) out.push_back(friction_increase(rows, m, j, creeps));
  for (const Joint link : payload_links(m.rigid.chain)) out.push_back(payload_change(rows, m, link));
  return out;
}

const LinearFault* linear_of(const std::vector<LinearFault>& faults, const FaultClaim& claim) {
  for (const LinearFault& fault : faults)
    if (fault.kind == column_kind(claim.kind) && fault.joint == claim.joint &&
        fault.columns.grow == claim.grows)
      return &fault;
  return nullptr;
}

FaultColumns force_columns(const BalanceRows& rows, const RowSetting& setting, double onset_s, double end_s) {
  const int n = rows.joints();
  const VectorXd lasts = soft_step(rows, setting, onset_s) - soft_step(rows, setting, end_s);
  const VectorXd share = (rows.time_s.array() - onset_s) / (end_s - onset_s);
  const int forms = static_cast<int>(kMeanOfForceForm.size());
  FaultColumns out{StackedColumns::Zero(rows.rows() * n, forms * n), VectorXd(forms * n)};
  for (int form = 0; form < forms; ++form) {
    const VectorXd force = form == 0 ? lasts : VectorXd(share.unaryExpr([form](double s) {
      return s > 0.0 && s < 1.0 ? elementary::sin(form * std::numbers::pi * s) : 0.0;
    }));
    for (int j = 0; j < n; ++j) {
      const int c = form * n + j;
      out.column.col(c).segment(j * rows.rows(), rows.rows()) = -force;  // it relieves the drive
      out.variance[c] =
          rows.torque.col(j).squaredNorm() / rows.rows() / Eigen::numext::abs2(std::max(form, 1));
    }
  }
  return out;
}

FaultColumns between(FaultColumns columns, const BalanceRows& rows, const RowSetting& setting, double onset_s,
                     double end_s) {
  VectorXd on = soft_step(rows, setting, onset_s);
  if (end_s < kNeverEnds) on -= soft_step(rows, setting, end_s);
  if (columns.grow) on.array() *= (rows.time_s.array() - onset_s).max(0.0);
  for (int j = 0; j < rows.joints(); ++j)
    columns.column.middleRows(j * rows.rows(), rows.rows()).array().colwise() *= on.array();
  return columns;
}

VectorXd soft_step(const BalanceRows& rows, const RowSetting& setting, double time_s) {
  const double width = std::max(setting.kernel_s, 0.3 * setting.row_s());
  return rows.time_s.unaryExpr([&](double t) { return normal_cdf((t - time_s) / width); });
}

StackedMask silent_rows(const BalanceRows& rows, const BalanceModel& m, const FaultClaim& claim) {
  // The position of a stuck encoder jumps at its end, which changes the rows within the whole kernel.
  const double reach = claim.kind == FaultKind::stuck_encoder
                           ? kReachOfJump * m.setting.kernel_s +
                                 std::min(velocity_reach_s(m.setting, kShowsInVelocity), kLongestReach_s)
                           : kReach * m.setting.kernel_s;
  const auto is_revolute = [&](int i) { return m.rigid.chain.geometry[i].kind == AxisKind::revolute; };
  const int j = claim.joint.index();
  StackedMask out(static_cast<std::size_t>(rows.rows() * rows.joints()), false);
  for (int i = 0; i < rows.joints(); ++i) {
    const bool coupled = claim.kind == FaultKind::stuck_encoder && is_revolute(j) && is_revolute(i);
    if (i != j && !coupled && !silences_all(claim)) continue;
    for (int k = 0; k < rows.rows(); ++k)
      out[i * rows.rows() + k] =
          rows.time_s[k] > claim.onset_s - reach && rows.time_s[k] < claim.end_s + reach;
  }
  return out;
}

namespace {

/// Replaces velocities around a jump, which the controller computed from the position, by differences of the
/// positions without the jump.
MeasuredMotion with_repaired_velocity(MeasuredMotion reading, const UniformLog& log, double jump_s) {
  const int rows = log.rows();
  for (int k = 0; k < rows; ++k) {
    if (log.time_s(k) < jump_s - kVelocityBefore_s || log.time_s(k) > jump_s + kVelocityAfter_s) continue;
    const int a = std::max(0, k - 1), b = std::min(rows - 1, k + 1);
    reading.dq[k] = (reading.q[b] - reading.q[a]) / (log.time_s(b) - log.time_s(a));
  }
  return reading;
}

}  // namespace

MeasuredMotion without_position_error(const UniformLog& log, const FaultClaim& claim) {
  MeasuredMotion out = reading_of(log, claim.joint.index());
  const bool shows_in_velocity = out.dq.size() > 0 && !claim.velocity_is_true;
  const double size = claim.size[0];
  for (int k = 0; k < log.rows(); ++k) {
    const double late = log.time_s(k) - claim.onset_s;
    if (late < -1e-9 || log.time_s(k) >= claim.end_s - 1e-9) continue;
    if (claim.kind == FaultKind::sensor_bias) {
      out.q[k] -= size;
    } else {
      out.q[k] -= size * std::max(late, 0.0);
      if (shows_in_velocity) out.dq[k] -= size;
    }
  }
  if (claim.kind == FaultKind::sensor_bias && shows_in_velocity)
    for (const double jump_s : {claim.onset_s, claim.end_s})
      out = with_repaired_velocity(std::move(out), log, jump_s);
  return out;
}

VectorXd fault_edges(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim) {
  const double reach = kEdgeKernels * std::max(setting.kernel_s, 0.3 * setting.row_s());
  return rows.time_s.unaryExpr([&](double t) {
    return std::abs(t - claim.onset_s) < reach || std::abs(t - claim.end_s) < reach ? 1.0 : 0.0;
  });
}

double form_share(FaultKind kind) { return kind == FaultKind::collision ? kShareOfBlow : kFormShare; }

VectorXd form_shares(const BalanceRows& rows, const RowSetting& setting, const FaultClaim& claim) {
  const double share = form_share(claim.kind);
  return fault_edges(rows, setting, claim).unaryExpr([share](double edge) {
    return std::max(share, kEdgeShare * edge);
  });
}

UniformLog without_position_errors(UniformLog log, const std::vector<FaultClaim>& known) {
  for (const FaultClaim& claim : known) {
    if (!falsifies_position(claim.kind)) continue;
    const MeasuredMotion mended = without_position_error(log, claim);
    log.q.col(claim.joint.index()) = mended.q;
    if (mended.dq.size() > 0) log.dq.col(claim.joint.index()) = mended.dq;
  }
  return log;
}

MatrixXd unstacked(const Stacked& values, int joints) {
  return Eigen::Map<const MatrixXd>(values.data(), values.size() / joints, joints);
}

Stacked stacked(const MatrixXd& values) { return Eigen::Map<const VectorXd>(values.data(), values.size()); }

}  // namespace faultline
