// SPDX-License-Identifier: MIT
#include "lib/fault/fault_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace faultline {
namespace {

struct Alike {
  FaultKind a, b;
  bool same_joint;
  const char* why;
};

constexpr std::array<Alike, 12> kAlike = {{
    {FaultKind::free_swinging, FaultKind::torque_loss, true,
     "losing all of the torque and swinging freely are the same motion; only the share lost distinguishes "
     "them"},
    {FaultKind::locked, FaultKind::stuck_encoder, true,
     "both show a position that does not change; only exactly repeated encoder codes and the motion of the "
     "other joints distinguish them"},
    {FaultKind::torque_loss, FaultKind::friction_increase, true,
     "both weaken the motion until the velocity reverses"},
    {FaultKind::torque_loss, FaultKind::payload_change, false,
     "a lifting joint with less torque and one with more load behave alike while only that joint moves"},
    {FaultKind::sensor_drift, FaultKind::collision, true,
     "a slow drift of the reading and a small outside force look alike over a short time"},
    {FaultKind::sensor_bias, FaultKind::sensor_drift, true,
     "an offset that grew quickly and a drift look alike over a short time"},
    {FaultKind::sensor_bias, FaultKind::collision, true,
     "one jump at the start and nothing after it can be an offset of the reading or a short push"},
    {FaultKind::friction_increase, FaultKind::payload_change, false,
     "more friction and more load both need more torque during acceleration"},
    {FaultKind::torque_sensor_error, FaultKind::collision, true,
     "a torque that is measured too high and an outside force look alike while the force acts"},
    {FaultKind::torque_sensor_error, FaultKind::payload_change, false,
     "at rest, a lifting joint whose torque is measured too high looks like one with more load"},
    {FaultKind::payload_change, FaultKind::payload_change, false,
     "a mass on one link and another mass on the next link are the same load while the joint between them "
     "rests"},
    {FaultKind::free_swinging, FaultKind::locked, true,
     "a joint that swings freely onto an end stop, or rests there, does not move either"},
}};

bool covers(const Alike& pair, const FaultLabel& a, const FaultLabel& b) {
  return pair.a == a.kind && pair.b == b.kind && (!pair.same_joint || a.joint == b.joint);
}

}  // namespace

const char* plain_name(FaultKind kind) { return describe(kind).heading; }

std::string plain_words(const FaultLabel& label) {
  if (label.joint <= 0) return describe(label.kind).heading;
  const FaultDescription& fault = describe(label.kind);
  return fmt::format("{} {} {}", fault.place == FaultPlace::link ? "link" : "joint", label.joint,
                     fault.of_a_joint);
}

std::string next_check_for(const FaultLabel& label) {
  const std::string joint = label.joint > 0 ? fmt::format("joint {}", label.joint) : "the joint";
  return fmt::format(fmt::runtime(describe(label.kind).next_check), joint);
}

std::string size_text(const FaultLabel& label, const std::array<double, kMostSizes>& sizes, bool turns) {
  return fmt::format(fmt::runtime(describe(label.kind).size_words), fmt::arg("first", sizes[0]),
                     fmt::arg("joint", label.joint), fmt::arg("second", sizes[1]),
                     fmt::arg("percent", 100.0 * sizes[0]), fmt::arg("magnitude", std::abs(sizes[0])),
                     fmt::arg("much", sizes[0] < 0.0 ? "little" : "much"),
                     fmt::arg("length", unit_of(SizeMeasure::length, turns)),
                     fmt::arg("torque", unit_of(SizeMeasure::torque, turns)));
}

std::string why_alike(const FaultLabel& a, const FaultLabel& b) {
  for (const Alike& pair : kAlike)
    if (covers(pair, a, b) || covers(pair, b, a)) return pair.why;
  return "";
}

}  // namespace faultline
