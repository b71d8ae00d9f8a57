// SPDX-License-Identifier: MIT
#include "lib/identify/extra/extra_columns.hpp"

#include <algorithm>
#include <cmath>

#include "lib/robot/fast_dynamics.hpp"

namespace faultline {
namespace {

/// A stretch with what the columns share.
class Columns {
 public:
  Columns(const ParameterSpace& space, const Stretch& stretch, const ExtraSetting& setting)
      : space_(space), s_(stretch), chain_(chain_of(space, setting)), dynamics_(chain_) {
    const int n = space.joints(), steps = s_.rows() - 1;
    torque_.resize(n, steps);
    carried_.resize(n, steps);
    for (int k = 0; k < steps; ++k) carried_.col(k) = carried(k);
    for (int j = 0; j < n; ++j) {
      const int shift = setting.shift.empty() ? 0 : setting.shift[j];
      for (int k = 0; k < steps; ++k)
        torque_(j, k) = (1.0 - setting.phi) * logged(j, k - shift) + setting.phi * logged(j, k + 1 - shift);
    }
  }

  /// Of one term: joints x samples.
  Eigen::MatrixXd of(const ExtraTerm& term) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(space_.joints(), s_.rows() - 1);
    switch (term.kind) {
      case ExtraKind::load_friction:
        add_load(term.joint, out);
        break;
      case ExtraKind::shared_inertia:
      case ExtraKind::shared_viscous:
      case ExtraKind::shared_coulomb:
        add_shared(term, out);
        break;
      case ExtraKind::ripple_cosine:
      case ExtraKind::ripple_sine:
        add_ripple(term, out);
        break;
      case ExtraKind::gear_compliance:
        add_compliance(term.joint, out);
        break;
    }
    return out;
  }

 private:
  /// The chain without extra torques: the setting may know nothing of them.
  static Chain<double> chain_of(const ParameterSpace& space, const ExtraSetting& setting) {
    ParameterSpace plain = space;
    plain.extra.clear();
    if (setting.parameters.size() == 0) return plain.chain;
    Eigen::VectorXd p(plain.count());
    p << setting.parameters.head(plain.extra_begin()), setting.parameters.tail(1 + plain.joints());
    return chain_from(plain, p);
  }

  double logged(int joint, int row) const { return s_.tau(joint, std::clamp(row, 0, s_.rows() - 1)); }
  double step(int k) const { return s_.time[k + 1] - s_.time[k]; }

  /// M ddq + h + G in the middle of a sample.
  JointVector<double> carried(int k) const {
    const JointVector<double> q = 0.5 * (s_.q_smooth.col(k) + s_.q_smooth.col(k + 1)),
                              dq = 0.5 * (s_.dq_smooth.col(k) + s_.dq_smooth.col(k + 1)),
                              ddq = (s_.dq_smooth.col(k + 1) - s_.dq_smooth.col(k)) / step(k);
    JointMatrix<double> inertia;
    JointVector<double> out;
    dynamics_.inertia_and_bias(q, dq, inertia, out);
    return out + inertia * ddq;
  }

  void add_load(int j, Eigen::MatrixXd& out) const {
    const double width = chain_.friction[j].width;
    double before = std::tanh(s_.dq_smooth(j, 0) / width);
    for (int k = 0; k < out.cols(); ++k) {
      const double after = std::tanh(s_.dq_smooth(j, k + 1) / width);
      out(j, k) = step(k) * std::abs(carried_(j, k)) * 0.5 * (before + after);
      before = after;
    }
  }

  void add_shared(const ExtraTerm& term, Eigen::MatrixXd& out) const {
    const SharedDrive& f = space_.chain.shared_drives[term.index];
    for (int k = 0; k < out.cols(); ++k) {
      const double from = f.speed(s_.dq_smooth.col(k).data()), to = f.speed(s_.dq_smooth.col(k + 1).data());
      if (term.kind == ExtraKind::shared_inertia) {
        out.col(k) = (to - from) * f.along;
        continue;
      }
      const double mean = term.kind == ExtraKind::shared_viscous
                              ? 0.5 * (from + to)
                              : 0.5 * (std::tanh(from / f.width) + std::tanh(to / f.width));
      out.col(k) = step(k) * mean * f.along;
    }
  }

  /// Integrated over a sample at constant velocity.
  void add_ripple(const ExtraTerm& term, Eigen::MatrixXd& out) const {
    const double rate = space_.chain.ripples[term.index].rate;
    for (int k = 0; k < out.cols(); ++k) {
      const double from = rate * s_.q_smooth(term.joint, k), to = rate * s_.q_smooth(term.joint, k + 1);
      const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
      const double share = std::abs(half) > 1e-6 ? std::sin(half) / half : 1.0;
      out(term.joint, k) =
          step(k) * share * (term.kind == ExtraKind::ripple_cosine ? std::cos(middle) : std::sin(middle));
    }
  }

  /// The link lags its drive by compliance times the torque tau_g in the gear, so that its momentum is less
  /// by M dtau_g/dt times the compliance; what the drive's own friction and rotor take does not pass the
  /// gear.
  void add_compliance(int j, Eigen::MatrixXd& out) const {
    const int n = space_.joints();
    const Friction<double>& f = chain_.friction[j];
    Eigen::VectorXd gear(out.cols());
    for (int k = 0; k < out.cols(); ++k) {
      const double from = s_.dq_smooth(j, k), to = s_.dq_smooth(j, k + 1), mean = 0.5 * (from + to);
      gear[k] = torque_(j, k) - f.viscous * mean - f.coulomb * std::tanh(mean / f.width) - f.offset -
                chain_.rotor_inertia[j] * (to - from) / step(k);
    }
    JointMatrix<double> inertia;
    JointVector<double> bias;
    Eigen::VectorXd before = Eigen::VectorXd::Zero(n), after = before;
    for (int k = 0; k + 1 < out.cols(); ++k) {
      const JointVector<double> q = s_.q_smooth.col(k + 1), dq = s_.dq_smooth.col(k + 1);
      dynamics_.inertia_and_bias(q, dq, inertia, bias);
      inertia(j, j) -= chain_.rotor_inertia[j];
      after = inertia.col(j) * (gear[k + 1] - gear[k]) / (0.5 * (step(k) + step(k + 1)));
      if (k > 0) out.col(k) = before - after;
      before = after;
    }
  }

  const ParameterSpace& space_;
  const Stretch& s_;
  Chain<double> chain_;
  FastDynamics dynamics_;
  Eigen::MatrixXd torque_;   ///< joints x samples: mean of the drives' torque over each
  Eigen::MatrixXd carried_;  ///< the same of what the gears carry
};

}  // namespace

Eigen::MatrixXd extra_columns(const ParameterSpace& space, const Stretch& stretch,
                              const ExtraSetting& setting) {
  const Eigen::Index n = space.joints(), terms = static_cast<Eigen::Index>(space.extra.size());
  Eigen::MatrixXd out(n * terms, stretch.rows() - 1);
  if (terms == 0) return out;
  const Columns columns(space, stretch, setting);
  for (Eigen::Index i = 0; i < terms; ++i) out.middleRows(i * n, n) = columns.of(space.extra[i]);
  return out;
}

}  // namespace faultline
