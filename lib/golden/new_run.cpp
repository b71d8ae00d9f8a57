// SPDX-License-Identifier: MIT
#include "lib/golden/new_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lib/core/error.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {
namespace {

constexpr int kSamplesBeyond = 3;  // in a row that leave a tolerance; one may be an outlier

using SignalKey = std::pair<std::string, Joint>;

bool have_one_motion(const RunSignals& a, const RunSignals& b) {
  if (a.motion.size() != b.motion.size()) return false;
  if (a.by_reference == b.by_reference) return align_runs(a, b, AlignmentKind::automatic).same_motion;
  return align_runs(by_positions(a), by_positions(b), AlignmentKind::automatic).same_motion;
}

/// Largest difference of each signal among the runs.
std::map<SignalKey, double> spread_of(const std::vector<const RunSignals*>& runs) {
  std::map<SignalKey, double> spread;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t k = i + 1; k < runs.size(); ++k)
      for (const SignalDifference& signal : compare_runs(*runs[i], *runs[k]).signals)
        if (signal.judged && std::isfinite(signal.largest)) {
          double& widest = spread[{signal.quantity, signal.joint}];
          widest = std::max(widest, std::abs(signal.largest));
        }
  for (auto& [key, widest] : spread) widest *= few_runs_factor(static_cast<int>(runs.size()));
  return spread;
}

double leaving_time(const SignalDifference& signal, double tolerance) {
  int in_a_row = 0;
  double since_s = signal.diverges_s;
  for (std::size_t i = 0; i < signal.difference.size(); ++i) {
    in_a_row = std::abs(signal.difference[i]) > tolerance ? in_a_row + 1 : 0;
    if (in_a_row == 1) since_s = signal.time[i];
    if (in_a_row == kSamplesBeyond) return since_s;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

SignalCheck checked(const SignalDifference& signal, const std::map<SignalKey, double>& spread,
                    const std::vector<WidenedTolerance>& widened, const std::vector<char>& turns) {
  SignalCheck check;
  check.quantity = signal.quantity;
  check.joint = signal.joint;
  check.unit = unit_of(signal, turns);
  check.largest = signal.largest;
  check.largest_s = signal.largest_s;
  check.judged = signal.judged;
  const auto found = spread.find({signal.quantity, signal.joint});
  check.tolerance = std::max(signal.threshold, found == spread.end() ? 0.0 : found->second);
  for (const WidenedTolerance& wider : widened)
    if (wider.quantity == signal.quantity && (wider.joint.is_none() || wider.joint == signal.joint)) {
      check.tolerance *= wider.factor;
      check.reason = wider.reason;
    }
  // Without a divergence beyond noise and interpolation there is nothing to explain.
  if (signal.judged && !std::isnan(signal.diverges_s)) check.leaves_s = leaving_time(signal, check.tolerance);
  return check;
}

/// The largest difference in tolerances; the nearest recorded run has the least.
double distance(const NewRunCheck& check) {
  double worst = 0.0;
  for (const SignalCheck& signal : check.signals)
    if (signal.judged && signal.tolerance > 0.0 && std::isfinite(signal.largest))
      worst = std::max(worst, std::abs(signal.largest) / signal.tolerance);
  return worst;
}

}  // namespace

double few_runs_factor(int recorded) {
  // Quantiles .99 of |new - nearest| / (largest - smallest) of 2, 3, .. normal draws and a new one.
  static constexpr std::array kFactors{54.1, 5.48, 2.45, 1.57, 1.17};
  const auto place = static_cast<std::size_t>(recorded - 2);
  return place < kFactors.size() ? kFactors[place] : 1.0;
}

std::vector<WidenedTolerance> widened_tolerances(const std::string& text, const std::string& where) {
  const TomlTable file = TomlTable::parse(text, where);
  std::vector<WidenedTolerance> all;
  for (const TomlTable& table : file.tables("widen")) {
    WidenedTolerance one;
    one.quantity = table.choice("signal", {"position", "velocity", "torque", "residual"});
    one.joint = Joint::numbered(static_cast<int>(table.integer("joint", 0)));
    one.factor = table.number("factor");
    if (one.factor < 1.0)
      table.fail("factor", "must be at least 1: a tolerance is never below what the recorded runs show");
    one.reason = table.text("reason");
    if (one.reason.find_first_not_of(" \t\n") == std::string::npos)
      table.fail("reason", "is empty; say in a sentence why this signal may differ more");
    all.push_back(one);
  }
  file.finish();
  return all;
}

const SignalCheck* NewRunCheck::first_leaving() const {
  const SignalCheck* first = nullptr;
  for (const SignalCheck& signal : signals)
    if (!std::isnan(signal.leaves_s) && (!first || signal.leaves_s < first->leaves_s)) first = &signal;
  return first;
}

NewRunCheck check_new_run(const RunSignals& run, const std::vector<RunSignals>& recorded,
                          const std::vector<WidenedTolerance>& widened, const std::vector<char>& turns) {
  std::vector<const RunSignals*> alike;
  for (const RunSignals& one : recorded)
    if (have_one_motion(one, run)) alike.push_back(&one);
  NewRunCheck best;
  best.log = run.name;
  best.recorded = static_cast<int>(alike.size());
  const std::map<SignalKey, double> spread = spread_of(alike);
  for (const RunSignals* one : alike) {
    const RunComparison comparison = compare_runs(*one, run);
    NewRunCheck check{run.name, one->name, best.recorded, comparison.alignment, {}};
    for (const SignalDifference& signal : comparison.signals)
      check.signals.push_back(checked(signal, spread, widened, turns));
    if (best.nearest.empty() || distance(check) < distance(best)) best = check;
  }
  return best;
}

}  // namespace faultline
