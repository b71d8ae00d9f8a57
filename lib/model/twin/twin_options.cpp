// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_options.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

/// Calls visit(key, value, words) for each number and range of TwinOptions except those of the faults, in the
/// order of display; the words state unit and meaning.
template <typename Options, typename Visit>
void visit_twin_fields(Options& o, Visit visit) {
  visit("least_length_s", o.least_length_s, "s, length of a run at least");
  visit("least_length_moves", o.least_length_moves, "usual moves in a run at least");
  visit("least_length_samples", o.least_length_samples, "samples in a run at least");
  visit("onset", o.onset, "of the run: when the fault begins");
  visit("quintic_share", o.quintic_share, "of runs move by quintics, the rest by trapezoids");
  visit("shortest_move_s", o.shortest_move_s, "s, usual move of the logs at least");
  visit("longest_move_s", o.longest_move_s, "s, usual move of the logs at most");
  visit("move", o.move, "of the usual move: length of a move");
  visit("dwell", o.dwell, "of the usual move: rest after a move");
  visit("pd_share", o.pd_share, "of runs under PD, the rest under computed torque");
  visit("mass_error", o.mass_error, "of each mass at most: error of the controller's model");
  visit("control_period_s", o.control_period_s, "s, if the torque changes between samples");
  visit("integration_share", o.integration_share, "of the control period: longest step of integration");
  visit("trip_speed", o.trip_speed, "of the usual speed: the drives trip");
  visit("attempts", o.attempts, "controllers drawn until one holds the robot");
  visit("stop_share", o.stop_share, "of runs with end stops");
  visit("stop_distance", o.stop_distance, "of the range: end stops beyond it");
  visit("second_push_share", o.second_push_share, "of collisions that push a second joint");
  visit("second_push", o.second_push, "of the first push: the second");
}

[[noreturn]] void bad(const std::string& key, const std::string& message) {
  throw Error(ErrorCode::usage, "TwinOptions." + key, message);
}

void check_range(const std::string& key, const DrawRange& range) {
  if (!(range.low <= range.high))
    bad(key, fmt::format("goes from {} to {}; the first number must not exceed the second", range.low,
                         range.high));
  if (range.low < 0.0) bad(key, fmt::format("begins at {}, must not be negative", range.low));
  if (range.spread == Spread::log_uniform && range.low <= 0.0)
    bad(key, fmt::format("is log-uniform from {}, must begin above 0", range.low));
}

void check_field(const std::string& key, double value) {
  if (!(value >= 0.0)) bad(key, fmt::format("is {}, must not be negative", value));
  if (key.ends_with("_share") && value > 1.0)
    bad(key, fmt::format("is {}, but a share must be at most 1", value));
}

void check_field(const std::string& key, const DrawRange& range) {
  if (range.spread != Spread::uniform || range.either_sign) bad(key, "can be uniform only");
  check_range(key, range);
}

void check_field(const std::string& key, int value) {
  if (value < 1) bad(key, fmt::format("is {}, must be at least 1", value));
}

Spread spread_from(const std::string& name) {
  for (const Spread spread : {Spread::uniform, Spread::log_uniform})
    if (name == to_string(spread)) return spread;
  throw Error(ErrorCode::input, "spread",
              "is \"" + name + "\", expected \"uniform\" or \"log_uniform\"; learn the model again");
}

std::string value_text(double value) { return fmt::format("{:g}", value); }
std::string value_text(int value) { return fmt::format("{}", value); }
std::string value_text(const DrawRange& range) {
  const char* sign = range.either_sign ? "+-" : "";
  const char* spread = range.spread == Spread::log_uniform ? ", log-uniform" : "";
  return fmt::format("{}{:g} to {:g}{}", sign, range.low, range.high, spread);
}

std::string line(const std::string& name, const std::string& value, const std::string& words) {
  return fmt::format("  {:<22} {:<28} {}\n", name, value, words);
}

std::string fault_text(const FaultDescription& fault, const TwinFault& twin) {
  std::string text;
  for (int s = 0; s < fault.size_count; ++s)
    text += line(s == 0 ? fault.name : "", value_text(twin.size[s]),
                 std::string("of ") + usual_of(fault.size[s].measure));
  if (fault.size_count == 0) text += line(fault.name, "-", "has no size");
  if (fault.passes) text += line("", value_text(twin.length_s), "s, how long it lasts");
  return text;
}

}  // namespace

std::array<TwinFault, kFaultKinds> catalogued_twin_faults() {
  std::array<TwinFault, kFaultKinds> faults;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    for (int s = 0; s < fault.size_count; ++s) faults[k].size[s] = fault.size[s].twin;
    faults[k].length_s = fault.twin_length_s;
  }
  return faults;
}

void TwinOptions::check() const {
  visit_twin_fields(*this, [](const char* key, const auto& value, const char*) { check_field(key, value); });
  if (!(control_period_s > 0.0)) bad("control_period_s", "is 0, must be above 0");
  if (shortest_move_s > longest_move_s)
    bad("shortest_move_s", fmt::format("is {}, above longest_move_s = {}", shortest_move_s, longest_move_s));
  if (onset.high > 1.0)
    bad("onset", fmt::format("ends at {}, but a share of the run must be at most 1", onset.high));
  for (int k = 0; k < kFaultKinds; ++k) {
    const std::string key = std::string("faults.") + to_string(static_cast<FaultKind>(k));
    for (const DrawRange& range : faults[k].size) check_range(key, range);
    check_range(key, faults[k].length_s);
  }
}

void fields(auto& v, MaybeConst<DrawRange> auto& range) {
  v("low", range.low);
  v("high", range.high);
  v.named("spread", range.spread, spread_from);
  v.unless_empty("either_sign", range.either_sign);
}

namespace {

Json fault_to_json(const FaultDescription& fault, const TwinFault& twin) {
  Json sizes = Json::array();
  for (int s = 0; s < fault.size_count; ++s) {
    Json size = fields_to_json<Json>(twin.size[s]);
    size["of"] = usual_of(fault.size[s].measure);
    sizes.push_back(size);
  }
  Json json{{"size", sizes}};
  if (fault.passes) json["length_s"] = fields_to_json<Json>(twin.length_s);
  return json;
}

void read_fault(const Json& json, const FaultDescription& fault, TwinFault& twin) {
  for (int s = 0; s < fault.size_count; ++s)
    twin.size[s] = fields_from_json<DrawRange>(json.at("size").at(s), "size");
  if (fault.passes) twin.length_s = fields_from_json<DrawRange>(json.at("length_s"), "length_s");
}

bool has_size(FaultKind kind) { return kind != FaultKind::unknown && describe(kind).size_count > 0; }

}  // namespace

Json twin_to_json(const TwinOptions& options) {
  FieldWriter<Json> writer;
  visit_twin_fields(options, [&](const char* key, const auto& value, const char*) { writer(key, value); });
  Json json = writer.json();
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    if (has_size(kind)) json["faults"][to_string(kind)] = fault_to_json(describe(kind), options.faults[k]);
  }
  return json;
}

TwinOptions twin_from_json(const Json& json, const std::string& where) {
  TwinOptions options;
  try {
    FieldReader<Json> reader(json, where);
    visit_twin_fields(options, [&](const char* key, auto& value, const char*) { reader(key, value); });
    for (int k = 0; k < kFaultKinds; ++k) {
      const FaultKind kind = static_cast<FaultKind>(k);
      if (has_size(kind))
        read_fault(json.at("faults").at(to_string(kind)), describe(kind), options.faults[k]);
    }
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::input, where, std::string("\"twin\" is damaged (") + error.what() + ")");
  }
  options.check();
  return options;
}

std::string twin_text(const TwinOptions& options) {
  std::string text = "Simulated runs of the identified robot that a model is learned and tested on\n\nRuns\n";
  visit_twin_fields(options, [&](const char* key, const auto& value, const char* words) {
    text += line(key, value_text(value), words);
  });
  text += "\nSizes of faults, against what is usual for the joint in the healthy logs\n";
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    if (describe(kind).place != FaultPlace::nowhere && kind != FaultKind::unknown)
      text += fault_text(describe(kind), options.faults[k]);
  }
  return text;
}

}  // namespace faultline
