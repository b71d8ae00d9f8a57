// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/window_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

constexpr double kHeldSteps = 1.6;  // prediction steps: a longer time between two is a gap in the log

std::vector<float> largest_of(const Envelope& envelope) {
  std::vector<float> out;
  for (std::size_t i = 0; i + 1 < envelope.values.size(); i += 2)
    out.push_back(std::max(envelope.values[i], envelope.values[i + 1]));
  return out;
}

/// Returns the predictions that end within [from_s, to_s].
Residuals part_of(const Residuals& residuals, double from_s, double to_s) {
  const double* begin = residuals.time.data();
  const double* end = begin + residuals.time.size();
  const auto first = std::lower_bound(begin, end, from_s) - begin;
  const auto count = std::max<std::ptrdiff_t>(std::upper_bound(begin, end, to_s) - begin - first, 0);
  Residuals part;
  part.row.assign(residuals.row.begin() + first, residuals.row.begin() + first + count);
  part.time = residuals.time.segment(first, count);
  part.position = residuals.position.middleCols(first, count);
  part.velocity = residuals.velocity.middleCols(first, count);
  part.torque = residuals.torque.middleCols(first, count);
  part.tau = residuals.tau.middleCols(first, count);
  part.ratio = residuals.ratio.middleCols(first, count);
  return part;
}

}  // namespace

WindowCurves::WindowCurves(const CurveWindow& window, const Model& model,
                           const std::vector<FaultLabel>& labels)
    : window_(window),
      model_(model),
      bins_per_s_(window.bins / (window.end_s - window.start_s)),
      held_s_(kHeldSteps * model.residual.shape.step_s * model.residual.shape.stride /
              std::max(model.residual.shape.step, 1)) {
  const EnvelopeBuilder empty(window.bins);
  joints_.assign(model.robot.joints(), JointColumns{empty, empty, empty, empty, empty, empty, empty});
  const std::vector<FaultLabel>& classes = model.samples.classifier.classes;
  for (const FaultLabel& label : labels) {
    const auto found = std::find(classes.begin(), classes.end(), label);
    if (found != classes.end()) networks_.push_back({label, found - classes.begin(), empty, empty});
  }
}

int WindowCurves::bin_of(double time_s) const {
  if (!(time_s >= window_.start_s && time_s <= window_.end_s)) return -1;
  return std::min(static_cast<int>((time_s - window_.start_s) * bins_per_s_), window_.bins - 1);
}

int WindowCurves::first_bin_of(int bin, double time_s, const Reached& last) const {
  const bool follows = last.bin >= 0 && time_s - last.time_s <= held_s_;
  return follows ? std::min(last.bin + 1, bin) : bin;
}

void WindowCurves::take(const Log& segment, const Residuals& residuals, const RequiredTorque& torque) {
  if (segment.rows() == 0 || segment.time.front() > window_.end_s || segment.time.back() < window_.start_s)
    return;
  for (int k = 0; k < segment.rows(); ++k)
    if (const int bin = bin_of(segment.time[k]); bin >= 0)
      take_row(segment, k, bin, torque, residuals.joints() == 0);
  take_predictions(segment, residuals);
  if (!networks_.empty()) take_outputs(residuals);
}

void WindowCurves::take_row(const Log& segment, int row, int bin, const RequiredTorque& torque,
                            bool by_reference) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointColumns& to = joints_[j];
    to.q.add(bin, segment.q[j][row]);
    if (!segment.tau.empty()) to.tau.add(bin, segment.tau[j][row]);
    if (!segment.dq.empty()) to.dq.add(bin, segment.dq[j][row]);
    if (torque.size() > 0) to.tau_required.add(bin, torque(static_cast<Eigen::Index>(j), row));
    if (!by_reference) continue;
    if (j < segment.q_ref.size()) to.q_predicted.add(bin, segment.q_ref[j][row]);
    if (j < segment.dq_ref.size()) to.dq_predicted.add(bin, segment.dq_ref[j][row]);
  }
}

void WindowCurves::take_predictions(const Log& segment, const Residuals& residuals) {
  for (int i = 0; i < residuals.count(); ++i) {
    const double time = residuals.time[i];
    const int bin = bin_of(time);
    if (bin < 0) continue;
    const int row = static_cast<int>(residuals.row[i] - segment.first_row);
    for (int b = first_bin_of(bin, time, predicted_); b <= bin; ++b)
      take_prediction(segment, row, residuals, i, b);
    predicted_ = {bin, time};
  }
}

void WindowCurves::take_prediction(const Log& segment, int row, const Residuals& residuals, int i, int bin) {
  const HealthyResiduals& healthy = model_.residual.healthy;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto joint = static_cast<Eigen::Index>(j);
    JointColumns& to = joints_[j];
    const ExpectedJoint expected = expected_joint(healthy, segment, row, residuals, i, static_cast<int>(j));
    to.residual.add(bin, std::abs(residuals.velocity(joint, i)));
    to.q_predicted.add(bin, expected.q);
    if (!segment.dq.empty()) to.dq_predicted.add(bin, expected.dq);
  }
}

void WindowCurves::take_outputs(const Residuals& residuals) {
  const Residuals part = part_of(residuals, window_.start_s, window_.end_s);
  if (part.count() == 0) return;
  const SampleOutputs outputs = classify_samples(model_.samples.classifier, part);
  for (Eigen::Index i = 0; i < outputs.time.size(); ++i) {
    const int bin = bin_of(outputs.time[i]);
    if (bin < 0) continue;
    for (Network& network : networks_)
      for (int b = first_bin_of(bin, outputs.time[i], classified_); b <= bin; ++b) {
        network.mlp.add(b, outputs.mlp(network.output, i));
        network.rbfn.add(b, outputs.rbfn(network.output, i));
      }
    classified_ = {bin, outputs.time[i]};
  }
}

CurveWindow WindowCurves::curves() const {
  CurveWindow out = window_;
  for (const JointColumns& joint : joints_)
    out.joints.push_back({joint.q.envelope(), joint.q_predicted.envelope(), joint.dq.envelope(),
                          joint.dq_predicted.envelope(), joint.tau.envelope(), joint.tau_required.envelope(),
                          largest_of(joint.residual.envelope())});
  for (const Network& network : networks_)
    out.networks.push_back({network.label, network.mlp.envelope(), network.rbfn.envelope()});
  return out;
}

ExpectedJoint expected_joint(const HealthyResiduals& healthy, const Log& segment, int row,
                             const Residuals& residuals, int i, int j) {
  ExpectedJoint expected;
  expected.q = segment.q[j][row] - residuals.position(j, i) * healthy.position_rms[j];
  expected.dq = segment.dq.empty() ? std::numeric_limits<double>::quiet_NaN()
                                   : segment.dq[j][row] - residuals.velocity(j, i) * healthy.velocity_rms[j];
  return expected;
}

}  // namespace faultline
