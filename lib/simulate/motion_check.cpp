// SPDX-License-Identifier: MIT
#include "lib/simulate/motion_check.hpp"

#include <fmt/format.h>

#include <string>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

[[noreturn]] void bad_motion(const char* key, const std::string& message) {
  throw Error(ErrorCode::usage, std::string("motion.") + key, message);
}

/// `given`, or the paper's bench ranges when it is empty.
std::vector<double> range_end(const Robot& robot, const std::vector<double>& given, const char* key,
                              bool high) {
  if (!given.empty() && static_cast<int>(given.size()) != robot.joints())
    bad_motion(key, fmt::format("expected {} numbers, found {}", robot.joints(), given.size()));
  if (!given.empty()) return given;
  std::vector<double> ends;
  for (const JointGeometry& joint : robot.chain.geometry)
    ends.push_back(joint.kind == AxisKind::revolute ? (high ? 2.0 : -2.0) : (high ? 0.05 : -0.35));
  return ends;
}

}  // namespace

JointRanges checked_ranges(const Robot& robot, const MotionSpec& spec) {
  const JointRanges ranges{range_end(robot, spec.low, "low", false),
                           range_end(robot, spec.high, "high", true)};
  for (int i = 0; i < robot.joints(); ++i)
    if (!(ranges.low[i] <= ranges.high[i]))
      bad_motion("low",
                 fmt::format("{} of joint {} is above high, {}", ranges.low[i], i + 1, ranges.high[i]));
  if (!(spec.move_min_s > 0.0 && spec.move_min_s <= spec.move_max_s))
    bad_motion("move_s", fmt::format("expected 0 < shortest <= longest, found {} and {}", spec.move_min_s,
                                     spec.move_max_s));
  if (!(spec.dwell_min_s >= 0.0 && spec.dwell_min_s <= spec.dwell_max_s))
    bad_motion("dwell_s", fmt::format("expected 0 <= shortest <= longest, found {} and {}", spec.dwell_min_s,
                                      spec.dwell_max_s));
  if (!(spec.blend > 0.0 && spec.blend <= 0.5))
    bad_motion("blend", fmt::format("expected 0 to 0.5, found {}", spec.blend));
  if (spec.harmonics < 1 || !(spec.fourier_period_s > 0.0))
    bad_motion("harmonics", "expected at least one harmonic and a positive period");
  for (const auto& point : spec.points)
    if (static_cast<int>(point.size()) != robot.joints())
      bad_motion("points",
                 fmt::format("expected points of {} numbers, found {}", robot.joints(), point.size()));
  return ranges;
}

void check_replay(const Robot& robot, const SampledMotion& replay) {
  const auto n = static_cast<std::size_t>(robot.joints());
  if (!(replay.period_s > 0.0)) bad_motion("replay", "expected samples with a positive period");
  if (replay.q.size() != n || replay.dq.size() != n || replay.q[0].size() < 2)
    bad_motion("replay", fmt::format("expected q and dq of {} joints with at least 2 samples", n));
  for (std::size_t i = 0; i < n; ++i)
    if (replay.q[i].size() != replay.q[0].size() || replay.dq[i].size() != replay.q[0].size())
      bad_motion("replay", "its columns differ in length");
}

}  // namespace faultline
