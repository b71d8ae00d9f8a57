// SPDX-License-Identifier: MIT
#include "lib/explain/judge/judge_force.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr int kForms = static_cast<int>(kMeanOfForceForm.size());
constexpr int kInstants = 50;      // of a force, at which its direction is looked at
constexpr double kOneSided = 0.9;  // least share of a push's force that its mean over time is

/// Returns the share of a joint's force that its mean over time is: 1 if it acts in one direction, near 0 if
/// it swings. `size`: of all forms, see kMeanOfForceForm.
double one_sided_share(const VectorXd& size, int joint, int joints) {
  double net = 0.0, total = 0.0;
  for (int k = 0; k < kInstants; ++k) {
    double force = size[joint];
    for (int form = 1; form < kForms; ++form)
      force += size[form * joints + joint] * elementary::sin(form * std::numbers::pi * (k + 0.5) / kInstants);
    net += force;
    total += std::abs(force);
  }
  return total > 0.0 ? std::abs(net) / total : 1.0;
}

/// Explanations of a log by a force from onset to end on all joints, or on one joint alone.
class ForceFit {
 public:
  ForceFit(const LogFit& fit, const FaultClaim& claim)
      : fit_(fit),
        onset_s_(claim.onset_s),
        columns_(force_columns(fit.rows(), fit.model().setting, claim.onset_s, claim.end_s)) {}

  /// Returns the explanation by these forms of a force on all joints.
  Explanation on_all(const std::vector<int>& forms) const {
    return explained_by(forms_on(0, fit_.joints(), forms));
  }
  /// Returns the explanation by these forms of a force on the joint (from 0) alone.
  Explanation on_joint(int j, const std::vector<int>& forms) const {
    return explained_by(forms_on(j, 1, forms));
  }
  /// Returns the joint (from 0) with the greatest force for its torque, by an explanation of all joints.
  int main_joint(const Explanation& all) const {
    const int n = fit_.joints();
    int out = 0;
    const VectorXd peak = all.size.head(n) + all.size.segment(n, n);
    peak.cwiseAbs2().cwiseQuotient(columns_.variance.head(n)).maxCoeff(&out);
    return out;
  }

 private:
  /// Returns the indices of these forms of a force on `count` joints from `first` (from 0) on.
  std::vector<int> forms_on(int first, int count, const std::vector<int>& forms) const {
    std::vector<int> out;
    for (const int form : forms)
      for (int j = first; j < first + count; ++j) out.push_back(form * fit_.joints() + j);
    return out;
  }

  Explanation explained_by(const std::vector<int>& some) const {
    std::vector<VectorXd> starts;
    if (fit_.has_piece()) starts.push_back(VectorXd::Zero(std::ssize(some)));
    const FaultColumns force{StackedColumns(columns_.column(Eigen::all, some)), columns_.variance(some)};
    Explanation e = fit_.explain_with_piece(fit_.residual(), force, starts, onset_s_);
    VectorXd size = VectorXd::Zero(columns_.sizes());
    size(some) = e.size;
    e.size = std::move(size);
    return e;
  }

  const LogFit& fit_;
  double onset_s_;
  FaultColumns columns_;
};

}  // namespace

FaultHypothesis judge_force(const LogFit& fit, FaultClaim claim) {
  const ForceFit force(fit, claim);
  const int n = fit.joints();
  const std::vector<int> constant = {0}, half_sine = {1}, plain = {0, 1}, every = {0, 1, 2, 3},
                         forms = claim.has_any_form ? every : plain;
  Explanation all = force.on_all(forms);
  const int j = force.main_joint(all);
  claim.joint = Joint::at(j);
  const auto likeliest = [&](std::vector<Explanation> some) {
    std::optional<Explanation> out;
    for (Explanation& e : some) {
      const bool swings = one_sided_share(e.size, j, n) < kOneSided;
      if (!swings && (!out || e.log_likelihood > out->log_likelihood)) out = std::move(e);
    }
    return out;
  };
  std::optional<Explanation> best = likeliest({std::move(all), force.on_joint(j, forms)});
  if (!best)
    best = likeliest({force.on_all(constant), force.on_joint(j, constant), force.on_all(half_sine),
                      force.on_joint(j, half_sine)});
  return hypothesis(fit, claim, std::move(*best), 0.0);
}

}  // namespace faultline
