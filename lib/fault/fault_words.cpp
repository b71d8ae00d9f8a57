// SPDX-License-Identifier: MIT
#include "lib/fault/fault_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

namespace faultline {
namespace {

struct KindWords {
  const char* name;        ///< as a heading
  const char* of_a_joint;  ///< after "joint N "
  const char* check;       ///< "{}" stands for the joint
};

constexpr std::array<KindWords, kFaultKinds> kWords = {{
    {"no fault", "shows no fault", "Nothing to do."},
    {"free-swinging joint (no torque)", "swings freely (no torque)",
     "Switch off and turn {} by hand: if the motor does not turn with it, look at coupling, belt and gear; "
     "if it does, look at motor cable, drive enable and drive fault memory."},
    {"locked joint", "is locked",
     "Check that the brake of {} releases (supply, wiring, wear), then look for a mechanical jam, a "
     "collision or a blocked end stop."},
    {"loss of torque", "lost a part of its torque",
     "Compare the motor current of {} with its command: a missing phase, a drive in current limit, a hot or "
     "weak motor, or a slipping belt lose torque."},
    {"position sensor offset", "reads a shifted position",
     "Move {} to its reference mark and compare the reading: look for a slipped encoder coupling, lost "
     "counts or a wrong home offset, then home again."},
    {"stuck encoder", "repeats the same reading",
     "Check the encoder of {}: cable, connector, supply and the status bits of its interface; move the joint "
     "by hand and watch whether the count changes."},
    {"position sensor drift", "reads a position that drifts",
     "Move {} to its reference mark several times in a row: a reading that walks away points to a slipping "
     "encoder coupling, lost counts or a warm sensor."},
    {"more friction", "turns against more friction",
     "Feel {} by hand with power off: look at bearings, seals, gear, brake drag and lubrication, and compare "
     "the motor current at slow constant speed in both directions."},
    {"changed payload", "carries another load",
     "Check what the gripper holds or lost, and the payload set in the controller; weigh the tool if in "
     "doubt."},
    {"collision or outside force", "was hit or pushed",
     "Look for contact marks and for what stood in the way at that time; check the tool and the tightness of "
     "{}, and that cables do not pull."},
    {"unknown fault", "shows an unknown fault",
     "No known fault and no recorded case fits. Look at the residuals of the joints around this time; when "
     "the cause is found, record it with `faultline cases add`, so that it is known the next time."},
}};

const KindWords& words_of(FaultKind kind) { return kWords[static_cast<std::size_t>(kind)]; }

struct Alike {
  FaultKind a, b;
  bool same_joint;
  const char* why;
};

constexpr std::array<Alike, 9> kAlike = {{
    {FaultKind::free_swinging, FaultKind::torque_loss, true,
     "losing all of the torque and swinging freely are the same motion; only the share lost tells them "
     "apart"},
    {FaultKind::locked, FaultKind::stuck_encoder, true,
     "both show a position that does not change; only exactly repeated encoder codes and the motion of the "
     "other joints tell them apart"},
    {FaultKind::torque_loss, FaultKind::friction_increase, true,
     "both weaken the motion until the velocity reverses"},
    {FaultKind::torque_loss, FaultKind::payload_change, false,
     "a lifting joint with less torque and one with more load move alike while only that joint moves"},
    {FaultKind::sensor_drift, FaultKind::collision, true,
     "a slow drift of the reading and a small outside force look alike over a short time"},
    {FaultKind::sensor_bias, FaultKind::sensor_drift, true,
     "an offset that grew quickly and a drift look alike over a short time"},
    {FaultKind::sensor_bias, FaultKind::collision, true,
     "one jump at the start and nothing after it can be an offset of the reading or a short push"},
    {FaultKind::friction_increase, FaultKind::payload_change, false,
     "more friction and more load both ask for more torque while speeding up"},
    {FaultKind::free_swinging, FaultKind::locked, true,
     "a joint that swings freely onto an end stop, or rests there, does not move either"},
}};

bool covers(const Alike& pair, const FaultLabel& a, const FaultLabel& b) {
  return pair.a == a.kind && pair.b == b.kind && (!pair.same_joint || a.joint == b.joint);
}

}  // namespace

const char* plain_name(FaultKind kind) { return words_of(kind).name; }

std::string plain_words(const FaultLabel& label) {
  if (label.joint <= 0) return words_of(label.kind).name;
  return fmt::format("joint {} {}", label.joint, words_of(label.kind).of_a_joint);
}

std::string next_check_for(const FaultLabel& label) {
  const std::string joint = label.joint > 0 ? fmt::format("joint {}", label.joint) : "the joint";
  return fmt::format(fmt::runtime(words_of(label.kind).check), joint);
}

std::string why_alike(const FaultLabel& a, const FaultLabel& b) {
  for (const Alike& pair : kAlike)
    if (covers(pair, a, b) || covers(pair, b, a)) return pair.why;
  return "";
}

}  // namespace faultline
