// SPDX-License-Identifier: MIT
#include "lib/identify/parameter_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

/// Returns the still joints that affect a parameter: its own for friction, all for other parameters.
std::vector<Joint> still_for(const Identification& id, int p, const std::vector<Joint>& still) {
  if (p < id.space.rigid() || p == id.space.timing()) return still;
  const Joint joint = id.space.joint_of(p);
  return has_joint(still, joint) ? std::vector<Joint>{joint} : std::vector<Joint>{};
}

/// Returns what to record so that the motion determines a parameter.
std::string not_excited(const std::vector<Joint>& still) {
  if (still.empty())
    return "these motions do not distinguish it from the other parameters; give a log in which every joint "
           "moves at changing speed and reverses";
  return fmt::format("joint {} never moves; give a log in which it moves and reverses",
                     fmt::join(still, ", "));
}

/// Returns why a parameter that the logs might determine keeps its nominal value; empty if it does not.
std::string why_kept(const Identification& id, int p, const TableFacts& facts) {
  const std::string useless = "it does not lower the held-out error",
                    slow = fmt::format("no log has a sample period below {:g} s", kShowsFriction_s);
  if (p > id.space.timing()) {
    if (id.method == IdentifyMethod::weak_form) return "only learn estimates it, from all its logs";
    return has_fast_log(id) ? "the logs do not determine this joint's Coulomb friction" : slow;
  }
  if (p < id.space.rigid()) return id.space.base[p].is_rotor && !(id.covariance(p, p) > 0.0) ? useless : "";
  if (facts.asked[p] || p < id.space.offset(0)) return "";
  if (p == id.space.timing()) return "the robot file states how torque runs between samples";
  return has_fast_log(id) ? useless : slow;
}

std::string why_not(const Identification& id, int p, const TableFacts& facts) {
  const std::vector<Joint> still = still_for(id, p, facts.still);
  if (!still.empty() && p != id.space.timing()) return not_excited(still);
  if (const std::string why = why_kept(id, p, facts); !why.empty())
    return fmt::format("left at {:g}: {}",
                       p > id.space.timing() ? elementary::exp(id.estimate[p]) : id.estimate[p], why);
  return p < id.space.rigid() ? why_not_identifiable(facts) : not_excited(still);
}

ParameterEstimate entry(const WeakFit& weak, const TableFacts& facts, const Identification& id, int p) {
  const bool is_width = p > id.space.timing(), is_free = id.covariance(p, p) > 0.0;
  ParameterEstimate e;
  e.name = id.space.name(p);
  e.unit = id.space.unit(p);
  e.value = is_width ? elementary::exp(id.estimate[p]) : id.estimate[p];
  e.identifiable = is_given_exactly(id.space, id.robot, p) || (is_free && (is_width || !weak.confounded[p]));
  e.std = std::sqrt(id.covariance(p, p)) * (is_width ? e.value : 1.0);
  if (!e.identifiable) e.why_not = why_not(id, p, facts);
  if (!e.identifiable) e.std = std::numeric_limits<double>::quiet_NaN();
  e.ci95 = {e.value - kNormal95 * e.std, e.value + kNormal95 * e.std};
  if (p < id.space.rigid()) e.meaning = id.space.base[p].meaning;
  return e;
}

}  // namespace

bool has_fast_log(const Identification& id) {
  return std::any_of(id.logs.begin(), id.logs.end(),
                     [](const IdentifiedLog& log) { return log.sample_period_s < kShowsFriction_s; });
}

std::string why_not_identifiable(const TableFacts& facts) {
  if (facts.still.empty() && !facts.leaning.empty())
    return fmt::format(
        "a friction offset of joint {0} would act like its mass and rotor; state fo{0} under [known], 0 if "
        "its friction is the same in both directions",
        facts.leaning.front());
  if (facts.still.empty() && !facts.undriven.empty())
    return fmt::format(
        "joint {} is hardly driven, and the other joints do not determine it; give a log in which it is "
        "driven",
        fmt::join(facts.undriven, ", "));
  return not_excited(facts.still);
}

std::vector<ParameterEstimate> base_parameter_table(const WeakFit& weak, const TableFacts& facts,
                                                    const Identification& id) {
  std::vector<ParameterEstimate> table;
  for (int p = 0; p < id.space.count(); ++p) {
    const bool is_rare = p >= id.space.bend(0) && p < id.space.timing();
    if (is_rare && id.estimate[p] == 0.0) continue;
    table.push_back(entry(weak, facts, id, p));
  }
  return table;
}

bool all_identifiable(const Identification& id) {
  for (int p = 0; p < id.space.offset(0); ++p)
    if (!id.base_parameters[p].identifiable && !(p < id.space.rigid() && id.space.base[p].is_rotor))
      return false;
  return true;
}

}  // namespace faultline
