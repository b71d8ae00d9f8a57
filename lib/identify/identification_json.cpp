// SPDX-License-Identifier: MIT
#include "lib/identify/identification_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_fields.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kSchema = "faultline/identification/1";

constexpr const char* kExtraKinds[] = {"load_friction", "shared_inertia", "shared_viscous", "shared_coulomb",
                                       "ripple_cosine", "ripple_sine",    "gear_compliance"};

std::string name_of(ExtraKind kind) { return kExtraKinds[static_cast<int>(kind)]; }

[[noreturn]] void refuse_term(const std::string& kind, const std::string& where) {
  throw Error(
      ErrorCode::input, where,
      fmt::format("names a model term \"{}\" that its robot does not have; identify again", printable(kind)));
}

ExtraKind extra_kind_from(const std::string& kind, const std::string& where) {
  const auto* const found = std::find(std::begin(kExtraKinds), std::end(kExtraKinds), kind);
  if (found == std::end(kExtraKinds)) refuse_term(kind, where);
  return static_cast<ExtraKind>(found - std::begin(kExtraKinds));
}

void check_term(const ExtraTerm& term, const Robot& robot, const std::string& where) {
  const auto list = is_ripple(term.kind)            ? robot.chain.ripples.size()
                    : is_of_shared_drive(term.kind) ? robot.chain.shared_drives.size()
                                                    : static_cast<std::size_t>(robot.joints());
  if (term.joint.is_none() || term.joint.index() >= robot.joints() || term.index < 0 ||
      static_cast<std::size_t>(term.index) >= list)
    refuse_term(name_of(term.kind), where);
}

template <typename Enum>
Enum enum_from(const std::string& name, std::initializer_list<Enum> all, const std::string& where) {
  if (const auto found = enum_named(name, all)) return *found;
  throw Error(ErrorCode::input, where,
              fmt::format("\"{}\" is no status or method of this version; identify again", name));
}

IdentificationStatus status_from(const std::string& name, const std::string& where) {
  using enum IdentificationStatus;
  return enum_from(name, {not_run, converged, not_converged, poorly_excited, poorly_explained, unexplained},
                   where);
}

IdentifyMethod method_from(const std::string& name, const std::string& where) {
  using enum IdentifyMethod;
  return enum_from(name, {automatic, weak_form, output_error}, where);
}

/// The parameters in the file, which belong to the robot in it.
struct State {
  std::string robot_file;
  std::vector<ExtraTerm> extra;
  std::vector<double> estimate, covariance;
};

void fields(auto& v, MaybeConst<State> auto& state) {
  v("robot_file", state.robot_file);
  v("extra", state.extra);
  v("estimate", state.estimate);
  v("covariance", state.covariance);
}

}  // namespace

void fields(auto& v, MaybeConst<ParameterEstimate> auto& e) {
  v("name", e.name);
  v("value", e.value);
  v("std", e.std);
  v("ci95", e.ci95);
  v("unit", e.unit);
  v("identifiable", e.identifiable);
  v("why_not", e.why_not);
  v.unless_empty("meaning", e.meaning);
}

void fields(auto& v, MaybeConst<IdentifiedLog> auto& log) {
  v("path", log.path);
  v("sha256", log.sha256);
  v("rows", log.rows);
  v("rows_used", log.rows_used);
  v("sample_period_s", log.sample_period_s);
  v("payload_kg", log.payload_kg);
  v("fit_r2", log.fit_r2);
  v("left_out", log.left_out);
}

void fields(auto& v, MaybeConst<ModelTerm> auto& term) {
  v("name", term.name);
  v("joint", term.joint);
  v("kept", term.kept);
  v("held_out_without", term.error_before);
  v("held_out_with", term.error_after);
}

void fields(auto& v, MaybeConst<ExtraTerm> auto& term) {
  v.as("kind", term.kind, name_of, extra_kind_from);
  v("joint", term.joint);
  v("index", term.index);
}

void fields(auto& v, MaybeConst<ResidualPattern> auto& p) {
  v("position", p.position);
  v("speed", p.speed);
  v("torque", p.torque);
  v("previous", p.previous);
  v("spectrum_hz", p.spectrum_hz);
  v("spectrum", p.spectrum);
}

void fields(auto& v, MaybeConst<JointExcitation> auto& e) {
  v("q_low", e.q_low);
  v("q_high", e.q_high);
  v("fastest_forward", e.fastest_forward);
  v("fastest_back", e.fastest_back);
  v("forward", e.forward);
  v("lacks", e.lacks);
}

void fields(auto& v, MaybeConst<ParameterExcitation> auto& e) {
  v("name", e.name);
  v("own", e.own);
  v("mixed_with", e.mixed_with);
}

void fields(auto& v, MaybeConst<Excitation> auto& e) {
  v("joints", e.joints);
  v("parameters", e.parameters);
  v.list("weakest", e.weakest, [](auto& inner, auto& weakest) {
    inner("name", weakest.first);
    inner("weight", weakest.second);
  });
}

void fields(auto& v, MaybeConst<LogValue> auto& value) {
  v.from_one("log", value.log);
  v("value", value.value);
  v("std", value.std);
  v("ci95", value.ci95);
}

void fields(auto& v, MaybeConst<ParameterTrend> auto& t) {
  v("name", t.name);
  v("unit", t.unit);
  v("by_log", t.by_log);
  v("mean", t.mean);
  v("chi_square", t.chi_square);
  v("p_same", t.p_same);
  v("slope", t.slope);
  v("slope_std", t.slope_std);
  v("p_level", t.p_level);
  v("differs", t.differs);
  v("drifts", t.drifts);
}

/// The summary, for display.
void fields(auto& v, MaybeConst<Identification> auto& id) {
  v.named("status", id.status, status_from);
  v("reason", id.reason);
  v.named("method", id.method, method_from);
  v("base_parameters", id.base_parameters);
  v("physical_parameters", id.physical_parameters);
  v("condition_number", id.condition_number);
  v("residual_rms", id.residual_rms);
  v("fit_r2", id.fit_r2);
  v("held_out_r2", id.held_out_r2);
  v("terms", id.terms);
  v("torque_delay_s", id.torque_delay_s);
  v("between_logs_std", id.between_logs_std);
  v("q_noise", id.q_noise);
  v("dq_noise", id.dq_noise);
  v("logs", id.logs);
}

namespace {

/// The patterns of the residual, the excitation and the trends of the parameters.
void verdict_fields(auto& v, MaybeConst<Identification> auto& id) {
  v("residual_repeats_with", id.residual_patterns);
  v("excitation", id.excitation);
  v("trend", id.trends);
}

FieldWriter<Json> written_summary(const Identification& id) {
  FieldWriter<Json> writer;
  writer("schema", kSchema);
  fields(writer, id);
  return writer;
}

State state_of(const Identification& id) {
  return {robot_file_text(id.robot),
          id.space.extra,
          {id.estimate.data(), id.estimate.data() + id.estimate.size()},
          {id.covariance.data(), id.covariance.data() + id.covariance.size()}};
}

void restore(const State& state, const std::string& where, Identification& id) {
  id.robot = robot_from_toml(state.robot_file, where);
  id.space = parameter_space(id.robot);
  for (const ExtraTerm& term : state.extra) check_term(term, id.robot, where);
  id.space.extra = state.extra;
  const auto count = static_cast<std::size_t>(id.space.count());
  if (state.estimate.size() != count || state.covariance.size() != count * count)
    throw Error(
        ErrorCode::input, where,
        fmt::format("holds {} parameters, its robot has {}; identify again", state.estimate.size(), count));
  const int n = id.space.count();
  id.estimate = Eigen::Map<const Eigen::VectorXd>(state.estimate.data(), n);
  id.covariance = Eigen::Map<const Eigen::MatrixXd>(state.covariance.data(), n, n);
}

Identification read(const Json& document, const std::string& where, bool is_summary) {
  if (!document.is_object() || document.value("schema", "") != kSchema)
    throw Error(ErrorCode::input, where,
                fmt::format("is not an identification of schema {}; identify again", kSchema));
  try {
    auto id = fields_from_json<Identification>(document, where);
    if (is_summary) return id;
    FieldReader<Json> reader(document, where);
    verdict_fields(reader, id);
    restore(fields_from_json<State>(document.at("state"), where), where, id);
    return id;
  } catch (const nlohmann::json::exception& e) {
    throw Error(ErrorCode::input, where, fmt::format("is incomplete ({}); identify again", e.what()));
  }
}

}  // namespace

nlohmann::ordered_json summary_to_json(const Identification& id) { return written_summary(id).json(); }

nlohmann::ordered_json to_json(const Identification& id) {
  FieldWriter<Json> writer = written_summary(id);
  verdict_fields(writer, id);
  writer("state", state_of(id));
  return writer.json();
}

Identification identification_from_json(const nlohmann::ordered_json& document, const std::string& where) {
  return read(document, where, false);
}

Identification summary_from_json(const nlohmann::ordered_json& document, const std::string& where) {
  return read(document, where, true);
}

}  // namespace faultline
