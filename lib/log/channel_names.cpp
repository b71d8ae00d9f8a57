// SPDX-License-Identifier: MIT
#include "lib/log/channel_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// A quantity as the prefix of a channel's name, and in words.
struct QuantityWords {
  const char *prefix, *meaning;
};

/// In the order of Quantity.
constexpr std::array<QuantityWords, 8> kQuantityWords{{{"t", "time"},
                                                       {"q", "position"},
                                                       {"dq", "velocity"},
                                                       {"tau", "torque"},
                                                       {"q_ref", "commanded position"},
                                                       {"dq_ref", "commanded velocity"},
                                                       {"tau_ref", "commanded torque"},
                                                       {"tau_meas", "measured torque"}}};
static_assert(kQuantityWords.size() == static_cast<std::size_t>(Quantity::tau_meas) + 1);

const char* prefix_of(Quantity quantity) { return kQuantityWords[static_cast<std::size_t>(quantity)].prefix; }

enum class Kind { other, upper, lower, digit };

Kind kind_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (std::isdigit(byte)) return Kind::digit;
  if (std::isupper(byte)) return Kind::upper;
  return std::isalpha(byte) ? Kind::lower : Kind::other;
}

/// Returns the runs of letters of a name, in lower case, and its numbers; "actualPos_12" gives actual,
/// pos, 12.
std::vector<std::string> letter_runs_of(const std::string& name) {
  std::vector<std::string> tokens;
  Kind before = Kind::other;
  for (const char c : name) {
    const Kind kind = kind_of(c);
    const bool goes_on = kind == before || (before == Kind::upper && kind == Kind::lower);
    if (kind != Kind::other && !goes_on) tokens.emplace_back();
    if (kind != Kind::other) tokens.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    before = kind;
  }
  return tokens;
}

bool among(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Returns the letter runs of a name, with German compounds divided: "Sollposition_12" gives soll,
/// position, 12.
std::vector<std::string> tokens_of(const std::string& name) {
  std::vector<std::string> words;
  for (std::string& run : letter_runs_of(name)) {
    for (const std::string_view first : {"soll", "ist"})
      if (run.starts_with(first) && among(run.substr(first.size()), {"position", "winkel", "geschwindigkeit",
                                                                     "moment", "drehmoment", "kraft"})) {
        words.emplace_back(first);
        run.erase(0, first.size());
      }
    words.push_back(std::move(run));
  }
  return words;
}

bool is_reference(const std::string& word) {
  return among(word, {"ref",     "reference", "des",       "desired", "set",  "setpoint",   "target",
                      "cmd",     "command",   "commanded", "goal",    "qg",   "references", "setpoints",
                      "targets", "cmds",      "commands",  "goals",   "soll", "nominal"});
}

bool is_measurement(const std::string& word) {
  return among(
      word, {"meas", "measured", "actual", "act", "feedback", "fb", "state", "states", "qm", "ist", "real"});
}

/// Words of columns that are related to a joint signal but are none.
bool is_something_else(const std::string& word) {
  return among(word, {"error",   "err",      "acc",       "accel",       "acceleration", "accelerations",
                      "qdd",     "ddq",      "tcp",       "pose",        "tool",         "max",
                      "min",     "limit",    "limited",   "fric",        "friction",     "pert",
                      "ext",     "external", "gravity",   "noise",       "std",          "threshold",
                      "output",  "multi",    "temp",      "temperature", "voltage",      "sec",
                      "nanosec", "stamp",    "cartesian", "wrench",      "ft",           "ee",
                      "jerk",    "removed",  "scaling",   "factor",      "pid"}) ||
         among(word, {"schleppfehler", "fehler", "differenz", "beschleunigung", "temperatur", "grenze"}) ||
         among(word, {"cart", "gripper", "flange", "world", "override", "x", "y", "z", "rx", "ry", "rz",
                      "roll", "pitch", "yaw"});
}

/// Words on how, or at which side of a joint, something was measured.
bool is_decoration(const std::string& word) {
  return is_reference(word) || is_measurement(word) ||
         among(word, {"con",    "ctrl", "control", "filt",    "filtered", "lp",    "raw",    "motor",
                      "link",   "load", "gear",    "encoder", "enc",      "abs",   "rel",    "joint",
                      "joints", "axis", "values",  "value",   "data",     "achse", "achsen", "gelenk"});
}

std::optional<Quantity> quantity_of(const std::string& word) {
  if (among(word, {"q", "qm", "qg", "pos", "position", "positions", "angle", "angles", "theta", "winkel"}))
    return Quantity::q;
  if (among(word, {"dq", "qd", "qdot", "vel", "velo", "velocity", "velocities", "speed", "speeds", "omega",
                   "dtheta", "geschwindigkeit"}))
    return Quantity::dq;
  if (among(word, {"tau", "torque", "torques", "trq", "effort", "efforts", "moment", "force", "forces",
                   "drehmoment", "kraft"}))
    return Quantity::tau;
  return std::nullopt;
}

int fitness_of(const std::vector<std::string>& words, Quantity quantity) {
  int fitness = 30;
  for (const std::string& word : words) {
    if (is_measurement(word)) fitness += quantity == Quantity::tau ? -10 : 5;
    if (among(word, {"con", "ctrl", "control"})) fitness -= 5;
    if (is_reference(word) && quantity == Quantity::tau) fitness -= 6;
    if (among(word, {"filt", "filtered", "lp"})) fitness -= 15;
    if (among(word, {"raw"})) fitness -= 2;
  }
  return fitness;
}

/// Returns the last part of a path-like name without decoration: "/a/header/Time" gives "time".
std::string leaf_of(const std::string& name) {
  const auto slash = name.find_last_of("/.");
  std::string leaf;
  for (const std::string& token : tokens_of(slash == std::string::npos ? name : name.substr(slash + 1))) {
    if (!leaf.empty()) leaf += '_';
    leaf += token;
  }
  return leaf;
}

int time_fitness(const std::string& name) {
  const std::string leaf = leaf_of(name);
  if (name == "t") return 100;
  if (among(leaf, {"t", "time"}) && name.find('/') == std::string::npos) return 90;
  if (among(leaf, {"timestamp", "time_stamp", "rosbag_timestamp", "stamp", "t_s", "datetime", "date_time",
                   "zeit", "zeitstempel", "temps", "tiempo", "tempo"}))
    return 80;
  if (among(leaf, {"elapsed", "elapsed_time", "time_elapsed", "program_time", "log_time", "controller_time"}))
    return 70;
  return 0;
}

}  // namespace

std::string to_string(Channel channel) {
  const std::string prefix = prefix_of(channel.quantity);
  return channel.quantity == Quantity::time ? prefix : fmt::format("{}{}", prefix, channel.joint);
}

std::optional<Channel> canonical_channel(const std::string& name) {
  const auto digits = name.find_last_not_of("0123456789");
  if (name == "t") return Channel{};
  if (digits == std::string::npos || digits + 1 == name.size() || name.size() - digits > 4)
    return std::nullopt;
  const std::string prefix = name.substr(0, digits + 1);
  const Joint joint = Joint::numbered(std::stoi(name.substr(digits + 1)));
  if (joint.is_none() || name[digits + 1] == '0') return std::nullopt;
  for (const Quantity quantity : kJointQuantities)
    if (prefix == prefix_of(quantity)) return Channel{quantity, joint};
  return std::nullopt;
}

const char* meaning_of(Quantity quantity) {
  return kQuantityWords[static_cast<std::size_t>(quantity)].meaning;
}

ParsedName parse_name(const std::string& name) {
  ParsedName reading;
  const auto words = tokens_of(name);
  int number_at = -1;
  bool reference = false, measured = false, other = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(words[i][0]))) number_at = static_cast<int>(i);
    if (const auto quantity = quantity_of(words[i])) reading.quantity = quantity;
    reference = reference || is_reference(words[i]);
    measured = measured || is_measurement(words[i]);
    other = other || is_something_else(words[i]);
  }
  for (const std::string& word : words)
    if (!quantity_of(word) && !is_decoration(word))
      reading.joint += (reading.joint.empty() ? "" : " ") + word;
  for (std::size_t i = 0; i < words.size(); ++i)
    reading.stem += (i ? " " : "") + (static_cast<int>(i) == number_at ? std::string("#") : words[i]);
  if (number_at >= 0 && words[number_at].size() <= 3) reading.number = std::stoi(words[number_at]);
  if (other) reading.quantity.reset();
  if (!reading.quantity) return reading;
  if (reading.quantity == Quantity::tau) reading.as_torque = fitness_of(words, Quantity::tau);
  reading.fitness = canonical_channel(name) ? 100 : fitness_of(words, *reading.quantity);
  if (reference && reading.quantity == Quantity::q) reading.quantity = Quantity::q_ref;
  if (reference && reading.quantity == Quantity::dq) reading.quantity = Quantity::dq_ref;
  if (reference && reading.quantity == Quantity::tau) reading.quantity = Quantity::tau_ref;
  if (measured && reading.quantity == Quantity::tau) reading.quantity = Quantity::tau_meas;
  return reading;
}

int find_time_column(const std::vector<std::string>& names) {
  int best = -1, best_fitness = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int fitness = time_fitness(names[i]);
    if (fitness > best_fitness) best = static_cast<int>(i), best_fitness = fitness;
  }
  return best;
}

std::string joint_count_sentence(const Issues& issues, int found, const std::string& whose, int wanted) {
  const std::string has = counted(found, "joint"), first = to_string({Quantity::q, Joint::at(found)});
  if (found > wanted)
    return fmt::format("is a log of another robot: it has {}, but {} has {}", has, whose, wanted);
  if (const Issue* missing = issues.find("channel_missing", first))
    return fmt::format("has positions of {} only, but {} has {}: {}", has, whose, wanted, missing->message);
  const std::string last = to_string({Quantity::q, Joint::at(wanted - 1)});
  return fmt::format(
      "has positions of {}, but {} has {}: it is a log of another robot, or {} not found among its columns; "
      "name such columns in the robot file: [log.columns] {} = {{name = \"...\"}}",
      has, whose, wanted, first == last ? first + " was" : first + " to " + last + " were", first);
}

}  // namespace faultline
