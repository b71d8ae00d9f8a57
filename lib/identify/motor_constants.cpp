// SPDX-License-Identifier: MIT
#include "lib/identify/motor_constants.hpp"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/matrix/decompositions.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kPriorTorque = 30.0;    // prior std of the torque of one column, in rms of all torques
constexpr double kLeastResidual = 0.02;  // of a joint's current: a smaller residual is not sought
constexpr int kConstantSteps = 30;       // iterations of each fit, at most
constexpr double kFrictionRidge = 1e-6;  // of the scaled columns of friction
constexpr double kConstantRange = 5.0;   // factor between two constants that is one prior std
constexpr double kSureFriction = 5.0;    // standard errors by which friction excludes a sign
constexpr double kSureSign = 9.0;        // chi-square by which the opposite sign is worse (3 standard errors)
constexpr double kSureConstants = 25.0;  // the same of equal constants
constexpr int kConstantWindows = 2;      // index of the window length: long windows average the noise
constexpr int kCheckedPoses = 50;        // at which the inertia matrix is computed
constexpr int kMostSignedJoints = 8;     // more joints would need too many combinations of signs

/// The windows of one joint as an upper triangular matrix: |A c theta - y| over the windows is
/// |factor_a c theta - factor_y|. Friction and offset are eliminated.
struct JointBalance {
  int joint = 0;
  Eigen::MatrixXd factor_a;
  Eigen::VectorXd factor_y;
  double scale = 1.0;  ///< residual of a fit to this joint alone
  /// Power that friction takes in that fit, in standard errors: positive for a current that counts along
  /// the axis, since friction opposes the motion.
  double friction = 0.0;
};

/// Returns the triangular factor of the columns with friction and offset eliminated: the last rows of the QR
/// decomposition that has them first.
Eigen::MatrixXd eliminated(const Eigen::MatrixXd& nuisance, const Eigen::MatrixXd& kept) {
  Eigen::MatrixXd all(nuisance.rows(), nuisance.cols() + kept.cols());
  all << nuisance, kept;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(all);
  const Eigen::Index rows = std::min(all.rows(), all.cols());
  const Eigen::MatrixXd r = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return r.bottomRightCorner(rows - nuisance.cols(), kept.cols());
}

/// Columns of one joint's windows: base parameters, friction (viscous, Coulomb, offset), torque.
struct JointColumns {
  Eigen::MatrixXd base, friction;
  Eigen::VectorXd torque;
};

JointColumns columns_of(const WeakSets& windows, int set, int j) {
  const std::vector<WeakWindow>& all = windows.sets[set].all();
  const auto rows = static_cast<Eigen::Index>(all.size());
  JointColumns out{Eigen::MatrixXd(rows, windows.space.rigid()), Eigen::MatrixXd(rows, 3),
                   Eigen::VectorXd(rows)};
  for (Eigen::Index k = 0; k < rows; ++k) {
    out.base.row(k) = all[k].base.row(j);
    out.friction.row(k) << all[k].viscous[j], all[k].coulomb(j, kOwnWidth), 1.0;
    out.torque[k] = all[k].torque(j, -windows.shifts.first);
  }
  return out;
}

/// Returns the balance of a joint. `column_scale` divides the base columns.
JointBalance balance_of(const JointColumns& columns, int j, const Eigen::VectorXd& column_scale,
                        double seconds) {
  const Eigen::Index bases = columns.base.cols();
  const auto rows = static_cast<double>(columns.base.rows());
  Eigen::MatrixXd kept(columns.base.rows(), bases + 1);
  kept << columns.base * column_scale.cwiseInverse().asDiagonal(), columns.torque;
  const Eigen::MatrixXd r = eliminated(columns.friction, kept) / std::sqrt(rows);
  JointBalance out{.joint = j, .factor_a = r.leftCols(bases), .factor_y = r.col(bases)};
  const double torque = out.factor_y.norm();
  const Eigen::MatrixXd prior =
      Eigen::MatrixXd::Identity(bases, bases) * Eigen::numext::abs2(kLeastResidual * torque / kPriorTorque);
  const Eigen::MatrixXd normal = out.factor_a.transpose() * out.factor_a + prior;
  const Eigen::VectorXd alone = solve_definite(normal, out.factor_a.transpose() * out.factor_y);
  out.scale = std::max((out.factor_y - out.factor_a * alone).norm(), kLeastResidual * torque);
  const Eigen::Matrix3d normal_of_friction =
      (columns.friction.transpose() * columns.friction +
       kFrictionRidge * Eigen::MatrixXd(columns.friction.colwise().squaredNorm().asDiagonal())) /
      rows;
  // Power of each friction column: its mean product with the speed.
  const Eigen::Vector3d power = columns.friction.transpose() * columns.friction.col(0) / rows;
  const Eigen::Vector3d weight = solve_definite(normal_of_friction, Eigen::Vector3d(power[0], power[1], 0.0));
  const Eigen::VectorXd row = columns.friction * weight / rows;
  const Eigen::RowVectorXd of_base = row.transpose() * kept.leftCols(bases);
  const double power_error =
      std::sqrt((row.squaredNorm() * rows + of_base * solve_definite(normal, of_base.transpose())) / seconds);
  out.friction = (row.dot(columns.torque) - of_base.dot(alone)) / (out.scale * power_error);
  return out;
}

/// Residual of one joint: (factor_a c theta - factor_y) / scale with c = sign e^x, over the square root of
/// the windows.
class JointCost : public ceres::CostFunction {
 public:
  JointCost(const JointBalance& balance, double sign) : balance_(balance), sign_(sign) {
    set_num_residuals(static_cast<int>(balance.factor_y.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(balance.factor_a.cols()));
    mutable_parameter_block_sizes()->push_back(1);
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Index bases = balance_.factor_a.cols(), rows = balance_.factor_a.rows();
    const Eigen::Map<const Eigen::VectorXd> theta(parameters[0], bases);
    const double c = sign_ * elementary::exp(parameters[1][0]);
    const Eigen::VectorXd current = c * (balance_.factor_a * theta);
    Eigen::Map<Eigen::VectorXd>(residuals, rows) = (current - balance_.factor_y) / balance_.scale;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (jacobians && jacobians[0])
      Eigen::Map<RowMajor>(jacobians[0], rows, bases) = c / balance_.scale * balance_.factor_a;
    if (jacobians && jacobians[1]) Eigen::Map<Eigen::VectorXd>(jacobians[1], rows) = current / balance_.scale;
    return true;
  }

 private:
  const JointBalance& balance_;
  double sign_;
};

/// A fit of the base parameters (scaled) and of the currents per torque, sign e^x, by balance.
struct ConstantFit {
  std::vector<double> sign;
  Eigen::VectorXd theta, x;
  /// Of the residuals, with what speaks against the signs: friction that drives the motion and a negative
  /// inertia count by the squares of their standard errors.
  double chi_square = std::numeric_limits<double>::infinity();
};

class ConstantProblem {
 public:
  /// `inertia`: row that gives the mean inertia of each balance from the scaled base parameters.
  ConstantProblem(std::vector<JointBalance> balances, Eigen::MatrixXd inertia, double seconds)
      : balances_(std::move(balances)), inertia_(std::move(inertia)), seconds_(seconds) {
    const auto explained = [](const JointBalance& b) { return b.factor_y.norm() / b.scale; };
    const auto best = std::max_element(
        balances_.begin(), balances_.end(),
        [&](const JointBalance& a, const JointBalance& b) { return explained(a) < explained(b); });
    reference_ = static_cast<int>(best - balances_.begin());
  }

  int count() const { return static_cast<int>(balances_.size()); }
  /// Returns the best explained joint.
  int reference() const { return reference_; }
  const JointBalance& balance(int k) const { return balances_[k]; }

  /// Returns the fit with these signs; with equal constants if `equal`.
  ConstantFit fit(const std::vector<double>& sign, bool equal) const {
    ConstantFit out{.sign = sign, .theta = {}, .x = Eigen::VectorXd::Zero(count())};
    out.theta = solve_definite(theta_normal(out), theta_right(out));
    const auto bases = static_cast<int>(out.theta.size());
    ceres::Problem problem;
    problem.AddParameterBlock(out.theta.data(), bases);
    for (int k = 0; k < count(); ++k) {
      problem.AddResidualBlock(new JointCost(balances_[k], sign[k]), nullptr, out.theta.data(), &out.x[k]);
      problem.AddResidualBlock(
          new ceres::NormalPrior(Eigen::MatrixXd::Constant(1, 1, constant_prior()), Eigen::VectorXd::Zero(1)),
          nullptr, &out.x[k]);
      if (equal || k == reference_) problem.SetParameterBlockConstant(&out.x[k]);
    }
    problem.AddResidualBlock(new ceres::NormalPrior(theta_prior() * Eigen::MatrixXd::Identity(bases, bases),
                                                    Eigen::VectorXd::Zero(bases)),
                             nullptr, out.theta.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = kConstantSteps;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    out.chi_square = 2.0 * summary.final_cost * seconds_ + against(out);
    return out;
  }

  /// Returns the standard error of each x, relative to the reference.
  Eigen::VectorXd error(const ConstantFit& fit) const {
    const Eigen::Index bases = fit.theta.size();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(bases + count(), bases + count());
    for (int k = 0; k < count(); ++k) {
      Eigen::MatrixXd j = Eigen::MatrixXd::Zero(balances_[k].factor_a.rows(), bases + count());
      j.leftCols(bases) = current(fit, k) / balances_[k].scale * balances_[k].factor_a;
      if (k != reference_) j.col(bases + k) = j.leftCols(bases) * fit.theta;
      normal += j.transpose() * j;
      normal(bases + k, bases + k) += k == reference_ ? 1.0 : constant_prior() * constant_prior();
    }
    normal.diagonal().head(bases).array() += theta_prior() * theta_prior();
    Eigen::VectorXd out =
        inverse_definite(normal * seconds_).diagonal().tail(count()).cwiseMax(0.0).cwiseSqrt();
    out[reference_] = 0.0;
    return out;
  }

 private:
  double theta_prior() const { return 1.0 / (kPriorTorque * balances_[reference_].factor_y.norm()); }
  double constant_prior() const { return 1.0 / (elementary::log(kConstantRange) * std::sqrt(seconds_)); }
  static double current(const ConstantFit& fit, int k) { return fit.sign[k] * elementary::exp(fit.x[k]); }

  Eigen::MatrixXd theta_normal(const ConstantFit& fit) const {
    const Eigen::Index bases = balances_.front().factor_a.cols();
    Eigen::MatrixXd normal = theta_prior() * theta_prior() * Eigen::MatrixXd::Identity(bases, bases);
    for (int k = 0; k < count(); ++k) {
      const double w = current(fit, k) / balances_[k].scale;
      normal += w * w * balances_[k].factor_a.transpose() * balances_[k].factor_a;
    }
    return normal;
  }
  Eigen::VectorXd theta_right(const ConstantFit& fit) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(balances_.front().factor_a.cols());
    for (int k = 0; k < count(); ++k)
      right += current(fit, k) / Eigen::numext::abs2(balances_[k].scale) *
               (balances_[k].factor_a.transpose() * balances_[k].factor_y);
    return right;
  }
  /// Returns the chi-square of what speaks against the signs.
  double against(const ConstantFit& fit) const {
    double out = 0.0;
    const Eigen::MatrixXd covariance = inverse_definite(theta_normal(fit) * seconds_);
    for (int k = 0; k < count(); ++k) {
      if (fit.sign[k] * balances_[k].friction < 0.0) out += Eigen::numext::abs2(balances_[k].friction);
      const Eigen::RowVectorXd row = inertia_.row(k);
      const double mean = row.dot(fit.theta);
      if (mean < 0.0) out += mean * mean / (row * covariance * row.transpose()).value();
    }
    return out;
  }

  std::vector<JointBalance> balances_;
  Eigen::MatrixXd inertia_;
  double seconds_ = 1.0;
  int reference_ = 0;
};

/// Returns the mean inertia of each joint in the windows as a row that multiplies the scaled base parameters.
Eigen::MatrixXd mean_inertia(const WeakSets& windows, int set, const Eigen::VectorXd& column_scale) {
  const ParameterSpace& space = windows.space;
  const std::vector<WeakWindow>& all = windows.sets[set].all();
  const std::size_t step = std::max<std::size_t>(1, all.size() / kCheckedPoses);
  const auto diagonal = [&](const Eigen::VectorXd& parameters) {
    const Chain chain = chain_from(space, parameters);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(space.joints());
    for (std::size_t k = 0; k < all.size(); k += step) {
      JointVector q = all[k].q;
      sum += inertia_matrix(chain, q).diagonal();
    }
    return sum;
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(space.count());
  const Eigen::VectorXd without = diagonal(none);
  Eigen::MatrixXd rows(space.joints(), space.rigid());
  for (int p = 0; p < space.rigid(); ++p) {
    Eigen::VectorXd one = none;
    one[p] = 1.0;
    rows.col(p) = (diagonal(one) - without) / column_scale[p];
  }
  return rows;
}

std::vector<JointBalance> balances_of(const WeakSets& windows, int set, const Eigen::VectorXd& column_scale,
                                      double seconds) {
  std::vector<JointBalance> out;
  for (int j = 0; j < windows.space.joints(); ++j)
    if (!has_joint(windows.still, Joint::at(j)))
      out.push_back(balance_of(columns_of(windows, set, j), j, column_scale, seconds));
  return out;
}

/// Returns the rms of each base column over the joints; 1 for a column that no motion excites.
Eigen::VectorXd column_scales(const WeakSets& windows, int set) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(windows.space.rigid());
  for (const WeakWindow& w : windows.sets[set].all()) sum += w.base.colwise().squaredNorm().transpose();
  sum = (sum / static_cast<double>(windows.sets[set].all().size())).cwiseSqrt();
  return (sum.array() > 1e-9 * sum.maxCoeff()).select(sum, 1.0);
}

/// Returns the fits with all signs that friction leaves open, the best one first.
std::vector<ConstantFit> fits_by_sign(const ConstantProblem& problem) {
  std::vector<ConstantFit> out;
  for (int signs = 0; signs < 1 << problem.count(); ++signs) {
    std::vector<double> sign;
    bool excluded = false;
    for (int k = 0; k < problem.count(); ++k) {
      sign.push_back((signs >> k) & 1 ? -1.0 : 1.0);
      excluded = excluded || sign.back() * problem.balance(k).friction < -kSureFriction;
    }
    if (!excluded) out.push_back(problem.fit(sign, false));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const ConstantFit& a, const ConstantFit& b) { return a.chi_square < b.chi_square; });
  return out;
}

}  // namespace

std::optional<MotorConstants> motor_constants(const WeakSets& windows) {
  const int n = windows.space.joints();
  const int set = std::min<int>(kConstantWindows, static_cast<int>(windows.sets.size()) - 1);
  const Eigen::VectorXd scale = column_scales(windows, set);
  const double seconds = seconds_covered(windows.sets[set]);
  std::vector<JointBalance> balances = balances_of(windows, set, scale, seconds);
  if (balances.size() < 2 || balances.size() > kMostSignedJoints) return std::nullopt;
  std::vector<int> joint;
  for (const JointBalance& balance : balances) joint.push_back(balance.joint);
  const ConstantProblem problem(std::move(balances), mean_inertia(windows, set, scale)(joint, Eigen::all),
                                seconds);
  const std::vector<ConstantFit> fits = fits_by_sign(problem);
  const ConstantFit& best = fits.front();
  const ConstantFit equal = problem.fit(std::vector<double>(joint.size(), 1.0), true);
  if (equal.chi_square < best.chi_square + kSureConstants) return std::nullopt;
  MotorConstants out{.reference = Joint::at(joint[problem.reference()]),
                     .constant = std::vector<double>(n, 1.0),
                     .uncertainty = std::vector<double>(n, 0.0),
                     .sign_is_known = std::vector<bool>(n, true)};
  const Eigen::VectorXd error = problem.error(best);
  for (int k = 0; k < problem.count(); ++k) {
    out.constant[joint[k]] = best.sign[k] * elementary::exp(-best.x[k]);
    out.uncertainty[joint[k]] = error[k];
    for (const ConstantFit& other : fits)
      if (other.sign[k] != best.sign[k] && other.chi_square < best.chi_square + kSureSign)
        out.sign_is_known[joint[k]] = false;
  }
  return out;
}

Issue motor_constants_issue(const MotorConstants& c) {
  std::vector<std::string> values, unknown;
  for (int j = 0; j < std::ssize(c.constant); ++j) {
    const Joint joint = Joint::at(j);
    values.push_back(joint == c.reference ? fmt::format("joint {} {:.3g}", joint, c.constant[j])
                                          : fmt::format("joint {} {:.3g} (+-{:.0f} %)", joint, c.constant[j],
                                                        200.0 * c.uncertainty[j]));
    if (!c.sign_is_known[j]) unknown.push_back(fmt::format("{}", joint));
  }
  std::string text = fmt::format(
      "the torques are motor currents; from the masses that joints share follows the torque per unit of "
      "current, relative to joint {}: {}. Masses and torques are in this unit: a scale of the torque columns "
      "in the robot file makes them kg and N m",
      c.reference, fmt::join(values, ", "));
  if (!unknown.empty())
    text += fmt::format("; these logs hardly determine the sign at joint {}", fmt::join(unknown, ", "));
  return make_issue("motor_constants", Severity::note, text);
}

}  // namespace faultline
