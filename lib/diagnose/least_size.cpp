// SPDX-License-Identifier: MIT
#include "lib/diagnose/least_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

bool is_small(const FaultFinding& fault) { return fault.extent.times_least < 1.0; }

/// Least value of a size of the label's kind, SI units.
double least_size_of(const FaultLabel& label, const FaultSize& size, const Model& model) {
  return model.robot.least_sizes.of(label.kind) * usual_size(model.motion, size.feature, label.joint.index());
}

std::string unit_at(const FaultLabel& label, const FaultSize& size, const Model& model) {
  return unit_of(size.feature, model.robot.chain.geometry[label.joint.index()].kind == AxisKind::revolute);
}

std::string amount_text(double size, const std::string& unit) {
  return unit == "1" ? fmt::format("{:.2g} %", 100.0 * size) : fmt::format("{:.2g} {}", size, unit);
}

/// Sum of times_least over all small findings with the label of `fault`.
double times_least_together(const FaultFinding& fault, const std::vector<FaultFinding>& faults) {
  double sum = 0.0;
  for (const FaultFinding& other : faults)
    if (other.label == fault.label && is_small(other)) sum += other.extent.times_least;
  return sum;
}

std::vector<FaultLabel> sized_labels(const Model& model) {
  std::vector<FaultLabel> labels = model.labels;
  std::erase_if(labels, [](const FaultLabel& label) { return !(describe(label.kind).least_size > 0.0); });
  return labels;
}

}  // namespace

FaultExtent extent_of(const FaultLabel& label, const std::vector<LabelEvidence>& evidence,
                      const Model& model) {
  FaultExtent extent;
  const auto found = std::find_if(evidence.begin(), evidence.end(),
                                  [&](const LabelEvidence& e) { return e.label == label; });
  if (label.joint.is_none() || found == evidence.end() || !(describe(label.kind).least_size > 0.0))
    return extent;
  const std::span<const FaultSize> sizes = describe(label.kind).sizes();
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    extent.size = found->size[s] * feature_scale(model.motion, sizes[s].feature, label.joint.index());
    extent.least_size = least_size_of(label, sizes[s], model);
    extent.unit = unit_at(label, sizes[s], model);
    extent.times_least = std::fmax(extent.times_least, std::abs(extent.size) / extent.least_size);
  }
  return extent;
}

FaultExtent extent_of_torque_loss(double share, const Model& model) {
  const double least = model.robot.least_sizes.of(FaultKind::torque_loss);
  return {share, least, unit_of(SizeMeasure::torque_share, true), share / least};
}

FaultsBySize faults_by_size(const std::vector<FaultFinding>& faults) {
  FaultsBySize out;
  for (const FaultFinding& fault : faults) {
    const bool too_small = is_small(fault) && times_least_together(fault, faults) < 1.0;
    (too_small ? out.small : out.kept).push_back(fault);
  }
  std::stable_sort(out.small.begin(), out.small.end(),
                   [](const auto& a, const auto& b) { return a.onset_s < b.onset_s; });
  return out;
}

std::string small_change_text(const FaultFinding& change, double sample_period_s) {
  const FaultExtent& extent = change.extent;
  return fmt::format("{}, from {} (confidence {}): {}, reported as a fault from {} on",
                     plain_words(change.label), time_text(change.onset_s, sample_period_s),
                     percent_text(change.confidence), amount_text(extent.size, extent.unit),
                     amount_text(extent.least_size, extent.unit));
}

std::vector<std::string> least_size_sentences(const Model& model) {
  std::string text;
  FaultKind kind = FaultKind::none;
  for (const FaultLabel& label : sized_labels(model)) {
    const FaultSize& size = describe(label.kind).sizes().back();
    const bool is_first = label.kind != kind;
    kind = label.kind;
    if (is_first) text += fmt::format("{}{}:", text.empty() ? "" : "; ", describe(kind).heading);
    text += fmt::format("{} joint {} {}", is_first ? "" : ",", label.joint,
                        amount_text(least_size_of(label, size, model), unit_at(label, size, model)));
  }
  if (text.empty()) return {};
  return {
      "Below these sizes, a change is listed as small and not reported as a fault ([least_size] of the robot "
      "file): " +
      text + "."};
}

}  // namespace faultline
