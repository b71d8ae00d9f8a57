// SPDX-License-Identifier: MIT
#include "lib/compare/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/compare/run_signals.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kFalseAlarms = 1e-3;  // probability of a divergence of two runs that differ by noise alone
// Successive samples beyond the threshold that make a divergence; one may be an outlier.
constexpr int kInARow = 3;
constexpr double kOtherPace = 0.02;  // largest relative difference of speed at which torques are judged
constexpr double kErrors = 3.0;      // factor on the errors of interpolation and time
constexpr double kRounding = 1e-9;   // of the largest value: rounding error of the arithmetic

/// Least noise of the difference of two residuals of healthy logs, each with rms 1; third differences
/// estimate less, as they are mostly taken at rest.
const double kHealthyResiduals = std::sqrt(2.0);

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  return largest;
}

double rms_of(const std::vector<double>& values) {
  double squares = 0.0, count = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) squares += v * v, count += 1.0;
  return count > 0.0 ? std::sqrt(squares / count) : std::numeric_limits<double>::quiet_NaN();
}

/// Difference of one signal at the samples of the first run.
class OneDifference {
 public:
  OneDifference(const RunSignal& first, const RunSignal& second, const RunComparison& all)
      : first_(first), second_(second), all_(all) {
    found_.quantity = first.quantity;
    found_.joint = first.joint;
    const double a = noise_of(first.values), b = noise_of(second.values);
    const double rounding = kRounding * std::max(largest_of(first.values), largest_of(second.values));
    const double known = first.quantity == "residual" ? kHealthyResiduals : rounding;
    found_.noise = std::max(std::sqrt(a * a + b * b), known);
    found_.threshold = all.sigmas * found_.noise;
  }

  SignalDifference take() {
    for (std::size_t i = 0; i < first_.time.size(); ++i) add(first_.time[i], first_.values[i]);
    if (count_ > 0) {
      found_.rms = std::sqrt(squares_ / count_);
      found_.beyond = beyond_ / count_;
    }
    found_.first_rms = rms_of(first_.values);
    found_.second_rms = rms_of(second_.values);
    const bool other_motion = !all_.alignment.same_motion && found_.quantity != "residual";
    if (other_motion || (found_.quantity == "torque" && other_pace_ > 0.0)) {
      found_.judged = false;
      found_.diverges_s = std::numeric_limits<double>::quiet_NaN();
    }
    return std::move(found_);
  }

 private:
  void add(double t, double value) {
    const double at = all_.alignment.second_at(t), rate = all_.alignment.rate_at(t);
    ValueBetween other = value_between(second_.time, second_.values, at, kGapPeriods * all_.second_period_s);
    if (found_.quantity == "velocity") other.value *= rate;
    const double d = other.value - value;
    found_.time.push_back(t);
    found_.first.push_back(value);
    found_.second.push_back(other.value);
    found_.difference.push_back(d);
    if (!std::isfinite(d)) return;
    count_ += 1.0;
    squares_ += d * d;
    other_pace_ += std::abs(rate - 1.0) > kOtherPace;
    if (!(std::abs(d) <= std::abs(found_.largest))) found_.largest = d, found_.largest_s = t;
    const bool leaves = std::abs(d) > found_.threshold + kErrors * (other.error + time_error(at));
    beyond_ += leaves;
    in_a_row_ = leaves ? in_a_row_ + 1 : 0;
    if (in_a_row_ == 1) since_ = t;
    if (in_a_row_ == kInARow && std::isnan(found_.diverges_s)) found_.diverges_s = since_;
  }

  /// Returns the error from the uncertainty of the time and the slope of the signal.
  double time_error(double at) const {
    if (all_.alignment.uncertain_s <= 0.0) return 0.0;
    const double h = all_.second_period_s, gap = kGapPeriods * h;
    const double slope = (value_between(second_.time, second_.values, at + h, gap).value -
                          value_between(second_.time, second_.values, at - h, gap).value) /
                         (2.0 * h);
    return std::isfinite(slope) ? std::abs(slope) * all_.alignment.uncertain_s : 0.0;
  }

  const RunSignal &first_, &second_;
  const RunComparison& all_;
  SignalDifference found_;
  double count_ = 0.0, squares_ = 0.0, beyond_ = 0.0, other_pace_ = 0.0, since_ = 0.0;
  int in_a_row_ = 0;
};

double overlap(const RunSignals& first, const RunSignals& second, const RunAlignment& alignment) {
  if (alignment.warped()) return alignment.first_s.back() - alignment.first_s.front();
  const double from = std::max(0.0, -alignment.shift_s);
  return std::min(first.length_s, second.length_s - alignment.shift_s) - from;
}

void refuse_unlike(const RunSignals& first, const RunSignals& second) {
  if (first.motion.size() == second.motion.size()) return;
  throw Error(ErrorCode::input, second.name,
              fmt::format("has {} joints and {} has {}; only runs of one robot can be compared",
                          second.motion.size(), first.name, first.motion.size()));
}

std::vector<std::string> notes_of(const RunSignals& first, const RunSignals& second,
                                  const RunComparison& all) {
  std::vector<std::string> notes;
  for (const char* quantity : {"velocity", "torque", "residual"}) {
    const bool one = first.find(quantity, 1_joint), other = second.find(quantity, 1_joint);
    if (one != other)
      notes.push_back(
          fmt::format("only {} has a {}; it is not compared", one ? first.name : second.name, quantity));
  }
  if (!all.alignment.same_motion)
    notes.push_back(
        first.find("residual", 1_joint)
            ? "signals of different motions must differ and are not judged; only the residuals are judged"
            : "signals of different motions must differ and are not judged; with --model the residuals of "
              "both are compared, which do not follow from the motion");
  for (const SignalDifference& signal : all.signals)
    if (!signal.judged && all.alignment.same_motion) {
      notes.push_back("torques are shown but not judged: moves of different duration need different torques");
      break;
    }
  const double alone = std::max(first.length_s, second.length_s) - all.compared_s;
  if (alone > std::max(first.period_s, second.period_s) * 2.0)
    notes.push_back(
        fmt::format("{:.3f} s of the longer run have no counterpart and are not compared", alone));
  return notes;
}

}  // namespace

const SignalDifference* RunComparison::first_divergence() const {
  const SignalDifference* earliest = nullptr;
  for (const SignalDifference& signal : signals)
    if (!std::isnan(signal.diverges_s) && (!earliest || signal.diverges_s < earliest->diverges_s))
      earliest = &signal;
  return earliest;
}

RunComparison compare_runs(RunSignals first, RunSignals second, AlignmentKind align) {
  refuse_unlike(first, second);
  if (first.by_reference != second.by_reference) {
    first = by_positions(std::move(first));
    second = by_positions(std::move(second));
  }
  RunComparison all;
  all.first = first.name;
  all.second = second.name;
  all.first_length_s = first.length_s;
  all.second_length_s = second.length_s;
  all.first_period_s = first.period_s;
  all.second_period_s = second.period_s;
  all.alignment = align_runs(first, second, align);
  all.compared_s = overlap(first, second, all.alignment);
  if (!(all.compared_s > 0.0))
    throw Error(ErrorCode::input, second.name, "has no time in common with " + first.name);
  double samples = 0.0;
  for (const RunSignal& signal : first.signals) samples += static_cast<double>(signal.time.size());
  // Exceeded in magnitude by a standard normal variable with a probability below kFalseAlarms / samples.
  all.sigmas = std::sqrt(-2.0 * elementary::log(kFalseAlarms / samples / 2.0));
  for (const RunSignal& signal : first.signals)
    if (const RunSignal* other = second.find(signal.quantity, signal.joint))
      all.signals.push_back(OneDifference(signal, *other, all).take());
  all.notes = notes_of(first, second, all);
  return all;
}

}  // namespace faultline
