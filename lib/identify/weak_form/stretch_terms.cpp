// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {
namespace {

constexpr double kTermsLongestStep_s = 0.012;  ///< longer samples are integrated by interpolation

/// Momentum and force of the base parameters and the friction terms at one state.
struct StateTerms {
  Eigen::MatrixXd momentum, force;  ///< joints x base
  Eigen::MatrixXd coulomb;          ///< joints x kWidths
};

class StateEvaluation {
 public:
  explicit StateEvaluation(const ParameterSpace& space) : space_(space) {
    const int n = space.joints();
    links_ = space.lift.topRows(n * kLinkParameters);
    rotors_ = space.lift.bottomRows(n);
    widths_.resize(n, kWidths);
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < kWidths; ++k) widths_(j, k) = weak_width(space, j, k);
  }

  void operator()(const Eigen::VectorXd& q, const Eigen::VectorXd& dq, StateTerms& terms) {
    const LinkFrames frames = link_frames(space_.chain, q);
    momentum_regressor(frames, dq, regressor_);
    terms.momentum.noalias() = regressor_ * links_;
    terms.momentum += dq.asDiagonal() * rotors_;
    force_regressor(frames, dq, regressor_);
    terms.force.noalias() = regressor_ * links_;
    terms.coulomb.resize(space_.joints(), kWidths);
    for (int j = 0; j < space_.joints(); ++j)
      for (int k = 0; k < kWidths; ++k) terms.coulomb(j, k) = elementary::tanh(dq[j] / widths_(j, k));
  }

 private:
  const ParameterSpace& space_;
  Eigen::MatrixXd links_, rotors_, widths_;
  LinkRegressor regressor_;
};

/// Interpolates position and velocity between two samples by the cubic through both at both ends.
void interpolate(const Stretch& s, int k, double x, Eigen::VectorXd& q, Eigen::VectorXd& dq) {
  const double h = s.time[k + 1] - s.time[k];
  const auto q0 = s.q_smooth.col(k), q1 = s.q_smooth.col(k + 1), v0 = s.dq_smooth.col(k),
             v1 = s.dq_smooth.col(k + 1);
  const double x2 = x * x, x3 = x2 * x;
  q = (2 * x3 - 3 * x2 + 1) * q0 + (x3 - 2 * x2 + x) * h * v0 + (3 * x2 - 2 * x3) * q1 + (x3 - x2) * h * v1;
  dq = (6 * x2 - 6 * x) / h * (q0 - q1) + (3 * x2 - 4 * x + 1) * v0 + (3 * x2 - 2 * x) * v1;
}

/// Computes the means of the integrated terms over one sample, from its ends and, on slow logs, within.
void add_inside(const Stretch& s, int k, StateEvaluation& evaluate, StateTerms& mean) {
  const int pieces = static_cast<int>(std::ceil((s.time[k + 1] - s.time[k]) / kTermsLongestStep_s));
  if (pieces < 2) return;
  Eigen::VectorXd q, dq;
  StateTerms inside;
  for (int i = 1; i < pieces; ++i) {
    interpolate(s, k, static_cast<double>(i) / pieces, q, dq);
    evaluate(q, dq, inside);
    mean.force += inside.force;
    mean.coulomb += inside.coulomb;
  }
  mean.force /= pieces;
  mean.coulomb /= pieces;
}

bool has(const ParameterSpace& space, ExtraKind kind) {
  return std::any_of(space.extra.begin(), space.extra.end(),
                     [kind](const ExtraTerm& term) { return term.kind == kind; });
}

/// Columns of the extra terms of a stretch, with what they share: the contribution of every sample to the
/// momentum balance. Shifted torques beyond the stretch are those at its ends.
class Columns {
 public:
  Columns(const ParameterSpace& space, const Stretch& stretch, const ExtraSetting& setting)
      : space_(space), s_(stretch), setting_(setting), chain_(chain_of(space, setting)), dynamics_(chain_) {}

  /// Returns all columns: (joints x terms) rows, term after term, x samples.
  Eigen::MatrixXd all() const {
    const Eigen::Index n = space_.joints(), terms = static_cast<Eigen::Index>(space_.extra.size());
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n * terms, s_.rows() - 1);
    const Eigen::MatrixXd carried =
        has(space_, ExtraKind::load_friction) ? carried_torque() : Eigen::MatrixXd();
    for (Eigen::Index i = 0; i < terms; ++i) {
      const ExtraTerm& term = space_.extra[i];
      Rows rows = out.middleRows(i * n, n);
      if (term.kind == ExtraKind::load_friction)
        add_load(term.joint.index(), carried.row(term.joint.index()), rows);
      else if (is_of_shared_drive(term.kind))
        add_shared(term, rows);
      else if (is_ripple(term.kind))
        add_ripple(term, rows);
    }
    if (has(space_, ExtraKind::gear_compliance)) add_compliances(out);
    return out;
  }

 private:
  using Rows = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  /// Returns the chain without extra torques, whose values the setting may not contain.
  static Chain chain_of(const ParameterSpace& space, const ExtraSetting& setting) {
    ParameterSpace plain = space;
    plain.extra.clear();
    if (setting.parameters.size() == 0) return plain.chain;
    Eigen::VectorXd p(plain.count());
    p << setting.parameters.head(plain.extra_begin()), setting.parameters.tail(1 + plain.joints());
    return chain_from(plain, p);
  }

  double logged(int j, int row) const { return s_.tau(j, std::clamp(row, 0, s_.rows() - 1)); }
  double step(int k) const { return s_.time[k + 1] - s_.time[k]; }

  /// Returns M ddq + h + G in the middle of each sample: joints x samples.
  Eigen::MatrixXd carried_torque() const {
    Eigen::MatrixXd out(space_.joints(), s_.rows() - 1);
    for (int k = 0; k < out.cols(); ++k) {
      const JointVector q = 0.5 * (s_.q_smooth.col(k) + s_.q_smooth.col(k + 1)),
                        dq = 0.5 * (s_.dq_smooth.col(k) + s_.dq_smooth.col(k + 1)),
                        ddq = (s_.dq_smooth.col(k + 1) - s_.dq_smooth.col(k)) / step(k);
      out.col(k) = dynamics_.body_torque(q, dq, ddq);
    }
    return out;
  }

  void add_load(int j, const Eigen::RowVectorXd& carried, Rows out) const {
    const double width = chain_.friction[j].width;
    double before = elementary::tanh(s_.dq_smooth(j, 0) / width);
    for (int k = 0; k < out.cols(); ++k) {
      const double after = elementary::tanh(s_.dq_smooth(j, k + 1) / width);
      out(j, k) = step(k) * std::abs(carried[k]) * 0.5 * (before + after);
      before = after;
    }
  }

  void add_shared(const ExtraTerm& term, Rows out) const {
    const SharedDrive& f = space_.chain.shared_drives[term.index];
    for (int k = 0; k < out.cols(); ++k) {
      const double from = f.speed(s_.dq_smooth.col(k).data()), to = f.speed(s_.dq_smooth.col(k + 1).data());
      if (term.kind == ExtraKind::shared_inertia) {
        out.col(k) = (to - from) * f.along;
        continue;
      }
      const double mean = term.kind == ExtraKind::shared_viscous
                              ? 0.5 * (from + to)
                              : 0.5 * (elementary::tanh(from / f.width) + elementary::tanh(to / f.width));
      out.col(k) = step(k) * mean * f.along;
    }
  }

  /// Integrates a ripple over a sample at constant velocity.
  void add_ripple(const ExtraTerm& term, Rows out) const {
    const int j = term.joint.index();
    const double rate = space_.chain.ripples[term.index].rate;
    for (int k = 0; k < out.cols(); ++k) {
      const double from = rate * s_.q_smooth(j, k), to = rate * s_.q_smooth(j, k + 1);
      const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
      const double share = std::abs(half) > 1e-6 ? elementary::sin(half) / half : 1.0;
      out(j, k) = step(k) * share *
                  (term.kind == ExtraKind::ripple_cosine ? elementary::cos(middle) : elementary::sin(middle));
    }
  }

  /// Returns the torque in the gear of joint `j` over sample `k`: the drive's, less its friction and rotor.
  double gear_torque(int j, int k) const {
    const Friction& f = chain_.friction[j];
    const int shift = setting_.shift.empty() ? 0 : setting_.shift[j];
    const double torque =
        (1.0 - setting_.phi) * logged(j, k - shift) + setting_.phi * logged(j, k + 1 - shift);
    const double from = s_.dq_smooth(j, k), to = s_.dq_smooth(j, k + 1), mean = 0.5 * (from + to);
    return torque - f.viscous * mean - f.coulomb * elementary::tanh(mean / f.width) - f.offset -
           chain_.rotor_inertia[j] * (to - from) / step(k);
  }

  /// Adds the columns of compliance: the link lags its drive by compliance times the torque tau_g in the
  /// gear, so its momentum is less by M dtau_g/dt times the compliance.
  void add_compliances(Eigen::MatrixXd& out) const {
    const Eigen::Index n = space_.joints(), terms = static_cast<Eigen::Index>(space_.extra.size());
    Eigen::MatrixXd before = Eigen::MatrixXd::Zero(n, n), after = before;  // a column for each gear
    for (int k = 0; k + 1 < out.cols(); ++k) {
      const JointVector q = s_.q_smooth.col(k + 1);
      const JointMatrix inertia = inertia_matrix(chain_, q);
      const double between = 0.5 * (step(k) + step(k + 1));
      for (Eigen::Index i = 0; i < terms; ++i) {
        const int j = space_.extra[i].joint.index();
        if (space_.extra[i].kind != ExtraKind::gear_compliance) continue;
        after.col(j) = inertia.col(j);
        after(j, j) -= chain_.rotor_inertia[j];
        after.col(j) *= (gear_torque(j, k + 1) - gear_torque(j, k)) / between;
        if (k > 0) out.col(k).segment(i * n, n) = before.col(j) - after.col(j);
      }
      std::swap(before, after);
    }
  }

  const ParameterSpace& space_;
  const Stretch& s_;
  const ExtraSetting& setting_;
  Chain chain_;
  FastDynamics dynamics_;
};

}  // namespace

double weak_width(const ParameterSpace& space, int j, int k) {
  // Factors on the robot's own width: a quarter of a decade apart near usual widths, coarser beyond.
  constexpr double kFactor[kWidths] = {0.01, 0.1, 0.3, 0.56, 1.0, 1.8, 3.0, 5.6, 10.0, 30.0, 100.0, 300.0};
  return kFactor[k] * space.chain.friction[j].width;
}

StretchTerms stretch_terms(const ParameterSpace& space, const Stretch& s, const ExtraSetting& setting) {
  const int n = space.joints(), steps = s.rows() - 1;
  StretchTerms out;
  out.base.resize(static_cast<Eigen::Index>(n) * space.rigid(), steps);
  out.coulomb.resize(n * kWidths, steps);
  out.step_s = s.time.tail(steps) - s.time.head(steps);
  out.skew = 0.5 * (s.dq_smooth.rightCols(steps).cwiseAbs() + s.dq_smooth.leftCols(steps).cwiseAbs()) *
             out.step_s.asDiagonal();
  out.viscous = s.q_smooth.rightCols(steps) - s.q_smooth.leftCols(steps);
  const Eigen::VectorXd rotor = Eigen::Map<const Eigen::VectorXd>(space.chain.rotor_inertia.data(), n);
  out.rotor = rotor.asDiagonal() * (s.dq_smooth.rightCols(steps) - s.dq_smooth.leftCols(steps));
  if (space.extra.empty())
    out.extra.resize(0, steps);
  else
    out.extra = Columns(space, s, setting).all();
  StateEvaluation evaluate(space);
  StateTerms from, to, mean;
  evaluate(s.q_smooth.col(0), s.dq_smooth.col(0), from);
  for (int k = 0; k < steps; ++k) {
    evaluate(s.q_smooth.col(k + 1), s.dq_smooth.col(k + 1), to);
    mean.force = 0.5 * (from.force + to.force);
    mean.coulomb = 0.5 * (from.coulomb + to.coulomb);
    add_inside(s, k, evaluate, mean);
    Eigen::Map<Eigen::MatrixXd>(out.base.col(k).data(), n, space.rigid()) =
        to.momentum - from.momentum - out.step_s[k] * mean.force;
    Eigen::Map<Eigen::MatrixXd>(out.coulomb.col(k).data(), n, kWidths) = out.step_s[k] * mean.coulomb;
    std::swap(from, to);
  }
  return out;
}

}  // namespace faultline
