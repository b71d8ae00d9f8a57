// SPDX-License-Identifier: MIT
#include "lib/fault/fault_catalogue.hpp"

#include <fmt/format.h>

#include <cmath>

namespace faultline {
namespace {

/// An offset, or its growth in a second, as a share of the range: from what a technician would notice to a
/// twenty-fifth, beyond which it is obvious without a program.
constexpr DrawRange kShareOfRange{
    .low = 0.003, .high = 0.04, .spread = Spread::log_uniform, .either_sign = true};

constexpr std::array<FaultDescription, kFaultKinds> kCatalogue = {{
    {
        .kind = FaultKind::none,
        .name = "none",
        .heading = "no fault",
        .of_a_joint = "{} shows no fault",
        .next_check = "Nothing to do.",
        .place = FaultPlace::nowhere,
    },
    {
        .kind = FaultKind::free_swinging,
        .name = "free_swinging",
        .heading = "free-swinging joint (no torque)",
        .of_a_joint = "{} swings freely (no torque)",
        .next_check =
            "Switch off and turn {} by hand: if the motor does not turn with it, look at coupling, belt and "
            "gear; if it does, look at motor cable, drive enable and drive fault memory.",
        .learn_more =
            "The joint moves as if its drive gave no torque: gravity, friction and the other joints alone "
            "explain its acceleration, whatever the command. A drive that is off, a broken coupling and a "
            "torn belt look alike in a log that has the command alone; a measured motor current near zero "
            "points to drive or cable, a usual current to coupling, belt or gear.",
        .acts_on = FaultActsOn::motion,
        .hidden_by_measured_torque = true,
    },
    {
        .kind = FaultKind::locked,
        .name = "locked",
        .heading = "locked joint",
        .of_a_joint = "{} is locked",
        .next_check =
            "Check that the brake of {} releases (supply, wiring, wear), then look for a mechanical jam, a "
            "collision or a blocked end stop.",
        .learn_more =
            "The velocity of the joint is zero within noise while its torque changes, and the other "
            "joints feel a joint that holds. A stuck encoder also reads one position, but repeats the "
            "same code exactly, and the other joints then move as if this one went on.",
        .acts_on = FaultActsOn::motion,
    },
    {
        .kind = FaultKind::torque_loss,
        .name = "torque_loss",
        .heading = "loss of torque",
        .of_a_joint = "{} lost a part of its torque",
        .next_check =
            "Compare the motor current of {} with its command: a missing phase, a drive in current limit, a "
            "hot or weak motor, or a slipping belt lose torque.",
        .learn_more =
            "The joint accelerates as if a fixed share of its torque were missing, so the error grows "
            "with the torque and vanishes when the joint rests without load. More friction also costs "
            "torque, but depends on the speed and not on the command.",
        .size_words = "about {percent:.0f} % of the torque is lost",
        .acts_on = FaultActsOn::motion,
        .hidden_by_measured_torque = true,
        .size = {{{
            .measure = SizeMeasure::torque_share,
            .twin = {.low = 0.2, .high = 0.9},  // less is wear, more is free-swinging
        }}},
        .size_count = 1,
        .least_size = 0.03,  // magnets and amplifiers differ by that much from day to day
    },
    {
        .kind = FaultKind::sensor_bias,
        .name = "sensor_bias",
        .heading = "position sensor offset",
        .of_a_joint = "the position sensor of {} reads a shifted position",
        .next_check =
            "Move {} to its reference mark and compare the reading: look for a slipped encoder coupling, "
            "lost counts or a wrong home offset, then home again.",
        .learn_more =
            "From one sample to the next the position is shifted while velocity and torque go on as "
            "before, and from then on gravity and inertia of the arm belong to another position than the "
            "one that is read. A collision also changes the motion suddenly, but position and velocity "
            "then agree with each other.",
        .size_words = "the position reads {magnitude:.4g} {length} too {much}",
        .acts_on = FaultActsOn::sensor,
        .shows_in_each_sample = false,  // only in its first one: later samples look healthy
        .size = {{{.measure = SizeMeasure::length, .twin = kShareOfRange}}},
        .size_count = 1,
        .least_size = 0.001,  // a tenth of a degree for a joint that turns by a quarter of a turn
    },
    {
        .kind = FaultKind::stuck_encoder,
        .name = "stuck_encoder",
        .heading = "stuck encoder",
        .of_a_joint = "the encoder of {} repeats one reading",
        .next_check =
            "Check the encoder of {}: cable, connector, supply and the status bits of its interface; move "
            "the joint by hand and watch whether the count changes.",
        .learn_more =
            "The position repeats one code exactly although torque and the other joints show that the "
            "joint moves. A locked joint has noise in its position and really stands still.",
        .acts_on = FaultActsOn::sensor,
    },
    {
        .kind = FaultKind::sensor_drift,
        .name = "sensor_drift",
        .heading = "position sensor drift",
        .of_a_joint = "the position sensor of {} drifts",
        .next_check = "Move {} to its reference mark several times in a row: a position that changes each "
                      "time points to a slipping encoder coupling, lost counts or a warm sensor.",
        .learn_more =
            "The position runs away from the integral of the velocity at a constant rate. An offset is "
            "shifted once and then stays.",
        .size_words = "the position drifts by {first:+.3g} {length}/s",
        .acts_on = FaultActsOn::sensor,
        .shows_in_each_sample = false,  // a drift changes next to nothing between samples
        .size = {{{.measure = SizeMeasure::length_per_s, .twin = kShareOfRange}}},
        .size_count = 1,
        .least_size = 0.0005,  // a bias that matters after two seconds
    },
    {
        .kind = FaultKind::friction_increase,
        .name = "friction_increase",
        .heading = "more friction",
        .of_a_joint = "{} turns against more friction",
        .next_check = "Turn {} by hand with power off: check bearings, seals, gear, brake drag and "
                      "lubrication, and compare the motor current at slow constant speed in both directions.",
        .learn_more =
            "More torque is needed against the direction of motion: a constant part (dry friction) and a "
            "part that grows with the speed (viscous friction). The program separates it from the usual "
            "changes of a day, such as a cold gear, by what the healthy logs differ in; a slow increase "
            "over weeks is shown by `faultline history`.",
        .size_words = "dry friction changed by {second:+.3g} {torque}, viscous friction by {first:+.3g} "
                      "{torque} s/{length}",
        .acts_on = FaultActsOn::motion,
        .size = {{{
                      .measure = SizeMeasure::viscous_friction,
                      .twin = {.low = 0.0, .high = 3.0},  // dry friction may rise alone
                  },
                  {
                      .measure = SizeMeasure::coulomb_friction,
                      .feature_name = "coulomb",
                      .twin = {.low = 0.4, .high = 3.0, .spread = Spread::log_uniform},
                  }}},
        .size_count = 2,
        .least_size = 0.1,  // temperature alone changes friction by more
    },
    {
        .kind = FaultKind::payload_change,
        .name = "payload_change",
        .heading = "changed payload",
        .of_a_joint = "{} carries another load",
        .next_check =
            "Check what the link behind {} carries or has lost (gripper and part, covers, cables, weights) "
            "and the payload set in the controller; weigh the tool if in doubt.",
        .learn_more =
            "Gravity and inertia belong to another mass at the end of the link, in rest and in motion, at "
            "all joints that carry it. A torque sensor with an offset needs a constant torque at one "
            "joint alone.",
        .size_words = "the load at the end of link {joint} changed by {first:+.3g} kg",
        .acts_on = FaultActsOn::motion,
        .place = FaultPlace::link,
        .size = {{{
            .measure = SizeMeasure::mass,
            .twin = {.low = 0.15, .high = 1.2, .spread = Spread::log_uniform},
        }}},
        .size_count = 1,
        .least_size = 0.03,  // hoses and tools change the load by that much
    },
    {
        .kind = FaultKind::collision,
        .name = "collision",
        .heading = "collision or outside force",
        .of_a_joint = "{} was hit or pushed",
        .next_check = "Look for contact marks and for obstacles in the way at that time; check the tool and "
                      "the tightness of {}, and that cables do not pull.",
        .learn_more =
            "A torque that no drive gave acts for some hundredths of a second to a second and is felt at "
            "several joints at once, in the directions in which a force at the arm can act. It is over "
            "before the end of the log; what stays is another kind of fault.",
        .size_words = "the push had an impulse of {first:+.3g} {torque} s",
        .acts_on = FaultActsOn::motion,
        .passes = true,
        .size = {{{
            .measure = SizeMeasure::torque,
            .feature = SizeMeasure::impulse,
            .twin = {.low = 0.15, .high = 1.0, .spread = Spread::log_uniform, .either_sign = true},
        }}},
        .size_count = 1,
        .least_size = 0.03,  // half of the least push that the twin draws
        .twin_length_s = {.low = 0.02, .high = 0.8, .spread = Spread::log_uniform},  // from a bump to a push
    },
    {
        .kind = FaultKind::torque_sensor_error,
        .name = "torque_sensor_error",
        .heading = "torque or current sensor offset",
        .of_a_joint = "the torque or current sensor of {} has an offset",
        .next_check = "Read torque or motor current of {} with the drive off: it should be 0. Look at the "
                      "zero of the current sensor, the calibration of the torque sensor and loose shields; "
                      "check also whether something leans on the arm or pulls at it.",
        .learn_more =
            "The torque that is read differs from the torque that the motion needs by a constant value, "
            "in rest and in motion, in both directions. A changed load needs a torque that depends on the "
            "position of the arm.",
        .size_words = "the torque reads {magnitude:.3g} {torque} too {much}",
        .acts_on = FaultActsOn::motion,  // a drive that misreads its current gives another torque
        .size = {{{
            .measure = SizeMeasure::torque,
            .twin = {.low = 0.1, .high = 0.6, .spread = Spread::log_uniform, .either_sign = true},
        }}},
        .size_count = 1,
        .least_size = 0.02,  // offsets of healthy days reach half of that
    },
    {
        .kind = FaultKind::unknown,
        .name = "unknown",
        .heading = "unknown fault",
        .of_a_joint = "{} shows an unknown fault",
        .next_check = "No known fault and no recorded case fits. Look at the residuals of the joints around "
                      "this time; when the cause is found, record it with `faultline cases add`, so that "
                      "similar cases are recognised.",
        .learn_more =
            "The log differs from a healthy one far beyond noise, and every known fault leaves most of "
            "the difference. The curve of the torque that would be needed shows when and at which joints "
            "it acts.",
        .acts_on = FaultActsOn::motion,
        .size = {{{.measure = SizeMeasure::torque}}},
        .size_count = 1,
    },
}};

constexpr bool every_kind_is_at_its_place() {
  for (int i = 0; i < kFaultKinds; ++i)
    if (kCatalogue[i].kind != static_cast<FaultKind>(i)) return false;
  return true;
}
static_assert(every_kind_is_at_its_place(), "a kind is missing in the catalogue or not in the enum's order");

}  // namespace

const FaultDescription& describe(FaultKind kind) { return kCatalogue[static_cast<std::size_t>(kind)]; }

std::vector<FaultLabel> fault_labels(int joints, const std::vector<Joint>& payload_links,
                                     bool torque_is_measured) {
  std::vector<FaultLabel> labels;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    const bool is_hidden = fault.hidden_by_measured_torque && torque_is_measured;
    if (fault.place == FaultPlace::nowhere || fault.kind == FaultKind::unknown || is_hidden) continue;
    if (fault.place == FaultPlace::link) {
      for (const Joint link : payload_links) labels.push_back({fault.kind, link});
      continue;
    }
    for (int j = 0; j < joints; ++j) labels.push_back({fault.kind, Joint::at(j)});
  }
  return labels;
}

const char* unit_of(SizeMeasure measure, bool turns) {
  switch (measure) {
    case SizeMeasure::torque_share:
      return "1";
    case SizeMeasure::length:
      return turns ? "rad" : "m";
    case SizeMeasure::length_per_s:
      return turns ? "rad/s" : "m/s";
    case SizeMeasure::viscous_friction:
      return turns ? "N m s/rad" : "N s/m";
    case SizeMeasure::coulomb_friction:
    case SizeMeasure::torque:
      return turns ? "N m" : "N";
    case SizeMeasure::mass:
      return "kg";
    case SizeMeasure::impulse:
      return turns ? "N m s" : "N s";
  }
  return "";
}

const char* usual_of(SizeMeasure measure) {
  static constexpr std::array kUsual{
      "the torque",           "the range",        "the range, per s",   "the viscous friction",
      "the Coulomb friction", "the mass carried", "the largest torque", "the impulse of a usual push"};
  static_assert(kUsual.size() == static_cast<std::size_t>(SizeMeasure::impulse) + 1);
  return kUsual[static_cast<std::size_t>(measure)];
}

const char* to_string(Spread spread) { return spread == Spread::uniform ? "uniform" : "log_uniform"; }

std::string plain_words(const FaultLabel& label) {
  if (label.joint.is_none()) return describe(label.kind).heading;
  const FaultDescription& fault = describe(label.kind);
  return fmt::format(fmt::runtime(fault.of_a_joint),
                     fmt::format("{} {}", fault.place == FaultPlace::link ? "link" : "joint", label.joint));
}

std::string next_check_for(const FaultLabel& label) {
  const std::string joint = label.joint.is_none() ? "the joint" : fmt::format("joint {}", label.joint);
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

}  // namespace faultline
