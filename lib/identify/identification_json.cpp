// SPDX-License-Identifier: MIT
#include "lib/identify/identification_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kSchema = "faultline/identification/1";

Json parameter(const ParameterEstimate& e) {
  Json out = {{"name", e.name},
              {"value", number_or_null(e.value)},
              {"std", number_or_null(e.std)},
              {"ci95", {number_or_null(e.ci95[0]), number_or_null(e.ci95[1])}},
              {"unit", e.unit},
              {"identifiable", e.identifiable},
              {"why_not", e.why_not}};
  if (!e.meaning.empty()) out["meaning"] = e.meaning;
  return out;
}

ParameterEstimate parameter_from(const Json& j) {
  ParameterEstimate e;
  e.name = j.at("name");
  e.value = number_or_nan(j.at("value"));
  e.std = number_or_nan(j.at("std"));
  e.ci95 = {number_or_nan(j.at("ci95").at(0)), number_or_nan(j.at("ci95").at(1))};
  e.unit = j.at("unit");
  e.identifiable = j.at("identifiable");
  e.why_not = j.at("why_not");
  e.meaning = j.value("meaning", "");
  return e;
}

Json log_json(const IdentifiedLog& log) {
  return {{"path", log.path},
          {"sha256", log.sha256},
          {"rows", log.rows},
          {"rows_used", log.rows_used},
          {"sample_period_s", number_or_null(log.sample_period_s)},
          {"payload_kg", number_or_null(log.payload_kg)},
          {"fit_r2", numbers_or_null(log.fit_r2)},
          {"left_out", log.left_out}};
}

IdentifiedLog log_from(const Json& j) {
  return {j.at("path"),
          j.at("sha256"),
          j.at("rows"),
          j.at("rows_used"),
          number_or_nan(j.at("sample_period_s")),
          number_or_nan(j.at("payload_kg")),
          numbers_or_nan(j.at("fit_r2")),
          j.at("left_out")};
}

Json term_json(const ModelTerm& t) {
  return {{"name", t.name},
          {"joint", t.joint + 1},
          {"kept", t.kept},
          {"held_out_without", number_or_null(t.error_before)},
          {"held_out_with", number_or_null(t.error_after)}};
}

ModelTerm term_from(const Json& j) {
  return {j.at("name"), j.at("joint").get<int>() - 1, j.at("kept"), number_or_nan(j.at("held_out_without")),
          number_or_nan(j.at("held_out_with"))};
}

constexpr const char* kExtraKinds[] = {"load_friction", "shared_inertia", "shared_viscous", "shared_coulomb",
                                       "ripple_cosine", "ripple_sine",    "gear_compliance"};

Json extra_json(const ExtraTerm& term) {
  return {
      {"kind", kExtraKinds[static_cast<int>(term.kind)]}, {"joint", term.joint + 1}, {"index", term.index}};
}

ExtraTerm extra_from(const Json& j, const Robot& robot, const std::string& where) {
  ExtraTerm term;
  const std::string kind = j.at("kind");
  const auto* const found = std::find(std::begin(kExtraKinds), std::end(kExtraKinds), kind);
  term.kind = static_cast<ExtraKind>(found - std::begin(kExtraKinds));
  term.joint = j.at("joint").get<int>() - 1;
  term.index = j.at("index");
  const auto list = is_ripple(term.kind)            ? robot.chain.ripples.size()
                    : is_of_shared_drive(term.kind) ? robot.chain.shared_drives.size()
                                                    : static_cast<std::size_t>(robot.joints());
  if (found == std::end(kExtraKinds) || term.joint < 0 || term.joint >= robot.joints() || term.index < 0 ||
      static_cast<std::size_t>(term.index) >= list)
    throw Error(ErrorCode::input, where,
                fmt::format("names a model term \"{}\" that its robot does not have; identify again",
                            printable(kind)));
  return term;
}

Json state_json(const Identification& id) {
  std::vector<double> estimate(id.estimate.data(), id.estimate.data() + id.estimate.size());
  std::vector<double> covariance(id.covariance.data(), id.covariance.data() + id.covariance.size());
  return {{"robot_file", robot_file_text(id.robot)},
          {"extra", list_of<Json>(id.space.extra, extra_json)},
          {"estimate", numbers_or_null(estimate)},
          {"covariance", numbers_or_null(covariance)}};
}

Json pattern_json(const ResidualPattern& p) {
  return {{"position", number_or_null(p.position)},
          {"speed", number_or_null(p.speed)},
          {"torque", number_or_null(p.torque)},
          {"previous", number_or_null(p.previous)},
          {"spectrum_hz", numbers_or_null(p.spectrum_hz)},
          {"spectrum", numbers_or_null(p.spectrum)}};
}

ResidualPattern pattern_from(const Json& j) {
  return {number_or_nan(j.at("position")),     number_or_nan(j.at("speed")),
          number_or_nan(j.at("torque")),       number_or_nan(j.at("previous")),
          numbers_or_nan(j.at("spectrum_hz")), numbers_or_nan(j.at("spectrum"))};
}

Json joint_json(const JointExcitation& e) {
  return {{"q_low", number_or_null(e.q_low)},
          {"q_high", number_or_null(e.q_high)},
          {"fastest_forward", number_or_null(e.fastest_forward)},
          {"fastest_back", number_or_null(e.fastest_back)},
          {"forward", number_or_null(e.forward)},
          {"lacks", e.lacks}};
}

JointExcitation joint_from(const Json& j) {
  return {number_or_nan(j.at("q_low")),           number_or_nan(j.at("q_high")),
          number_or_nan(j.at("fastest_forward")), number_or_nan(j.at("fastest_back")),
          number_or_nan(j.at("forward")),         j.at("lacks")};
}

Json parameter_json(const ParameterExcitation& e) {
  return {{"name", e.name}, {"own", number_or_null(e.own)}, {"mixed_with", e.mixed_with}};
}

Json weakest_json(const std::pair<std::string, double>& w) {
  return {{"name", w.first}, {"weight", number_or_null(w.second)}};
}

Json excitation_json(const Excitation& e) {
  return {{"joints", list_of<Json>(e.joints, joint_json)},
          {"parameters", list_of<Json>(e.parameters, parameter_json)},
          {"weakest", list_of<Json>(e.weakest, weakest_json)}};
}

Excitation excitation_from(const Json& j) {
  Excitation e;
  for (const Json& joint : j.at("joints")) e.joints.push_back(joint_from(joint));
  for (const Json& p : j.at("parameters"))
    e.parameters.push_back({p.at("name"), number_or_nan(p.at("own")), p.at("mixed_with")});
  for (const Json& w : j.at("weakest")) e.weakest.emplace_back(w.at("name"), number_or_nan(w.at("weight")));
  return e;
}

Json value_json(const LogValue& v) {
  return {{"log", v.log + 1},
          {"value", number_or_null(v.value)},
          {"std", number_or_null(v.std)},
          {"ci95", {number_or_null(v.ci95[0]), number_or_null(v.ci95[1])}}};
}

LogValue value_from(const Json& j) {
  return {j.at("log").get<int>() - 1,
          number_or_nan(j.at("value")),
          number_or_nan(j.at("std")),
          {number_or_nan(j.at("ci95").at(0)), number_or_nan(j.at("ci95").at(1))}};
}

Json trend_json(const ParameterTrend& t) {
  return {{"name", t.name},
          {"unit", t.unit},
          {"by_log", list_of<Json>(t.by_log, value_json)},
          {"mean", number_or_null(t.mean)},
          {"chi_square", number_or_null(t.chi_square)},
          {"p_same", number_or_null(t.p_same)},
          {"slope", number_or_null(t.slope)},
          {"slope_std", number_or_null(t.slope_std)},
          {"p_level", number_or_null(t.p_level)},
          {"differs", t.differs},
          {"drifts", t.drifts}};
}

ParameterTrend trend_from(const Json& j) {
  ParameterTrend t;
  t.name = j.at("name");
  t.unit = j.at("unit");
  for (const Json& value : j.at("by_log")) t.by_log.push_back(value_from(value));
  t.mean = number_or_nan(j.at("mean"));
  t.chi_square = number_or_nan(j.at("chi_square"));
  t.p_same = number_or_nan(j.at("p_same"));
  t.slope = number_or_nan(j.at("slope"));
  t.slope_std = number_or_nan(j.at("slope_std"));
  t.p_level = number_or_nan(j.at("p_level"));
  t.differs = j.at("differs");
  t.drifts = j.at("drifts");
  return t;
}

/// Adds the patterns of the residual, the excitation and the trends of the parameters.
void add_verdicts(const Identification& id, Json& document) {
  document["residual_repeats_with"] = list_of<Json>(id.residual_patterns, pattern_json);
  document["excitation"] = excitation_json(id.excitation);
  document["trend"] = list_of<Json>(id.trends, trend_json);
}

void read_verdicts(const Json& document, Identification& id) {
  for (const Json& p : document.at("residual_repeats_with")) id.residual_patterns.push_back(pattern_from(p));
  id.excitation = excitation_from(document.at("excitation"));
  for (const Json& t : document.at("trend")) id.trends.push_back(trend_from(t));
}

template <typename Enum>
Enum enum_from(const std::string& name, std::initializer_list<Enum> all, const std::string& where) {
  if (const auto found = enum_named(name, all)) return *found;
  throw Error(ErrorCode::input, where,
              fmt::format("\"{}\" is no status or method of this version; identify again", name));
}

Identification read_summary(const Json& j, const std::string& where) {
  using Status = IdentificationStatus;
  using Method = IdentifyMethod;
  Identification id;
  id.status = enum_from(j.at("status").get<std::string>(),
                        {Status::not_run, Status::converged, Status::not_converged, Status::poorly_excited,
                         Status::poorly_explained, Status::unexplained},
                        where);
  id.reason = j.at("reason");
  id.method = enum_from(j.at("method").get<std::string>(),
                        {Method::automatic, Method::weak_form, Method::output_error}, where);
  for (const Json& p : j.at("base_parameters")) id.base_parameters.push_back(parameter_from(p));
  for (const Json& p : j.at("physical_parameters")) id.physical_parameters.push_back(parameter_from(p));
  id.q_noise = numbers_or_nan(j.at("q_noise"));
  id.dq_noise = numbers_or_nan(j.at("dq_noise"));
  id.condition_number = number_or_nan(j.at("condition_number"));
  id.residual_rms = numbers_or_nan(j.at("residual_rms"));
  id.fit_r2 = numbers_or_nan(j.at("fit_r2"));
  id.held_out_r2 = numbers_or_nan(j.at("held_out_r2"));
  for (const Json& term : j.at("terms")) id.terms.push_back(term_from(term));
  id.torque_delay_s = numbers_or_nan(j.at("torque_delay_s"));
  id.between_logs_std = numbers_or_nan(j.at("between_logs_std"));
  for (const Json& log : j.at("logs")) id.logs.push_back(log_from(log));
  return id;
}

Identification read(const Json& j, const std::string& where) {
  Identification id = read_summary(j, where);
  read_verdicts(j, id);
  const Json& state = j.at("state");
  id.robot = robot_from_toml(state.at("robot_file").get<std::string>(), where);
  id.space = parameter_space(id.robot);
  id.space.extra.clear();
  for (const Json& term : state.at("extra")) id.space.extra.push_back(extra_from(term, id.robot, where));
  const auto estimate = numbers_or_nan(state.at("estimate")),
             covariance = numbers_or_nan(state.at("covariance"));
  const auto count = static_cast<std::size_t>(id.space.count());
  if (estimate.size() != count || covariance.size() != count * count)
    throw Error(ErrorCode::input, where,
                fmt::format("holds {} parameters, its robot has {}; identify again", estimate.size(), count));
  id.estimate = Eigen::Map<const Eigen::VectorXd>(estimate.data(), id.space.count());
  id.covariance = Eigen::Map<const Eigen::MatrixXd>(covariance.data(), id.space.count(), id.space.count());
  return id;
}

}  // namespace

nlohmann::ordered_json summary_to_json(const Identification& id) {
  return {{"schema", kSchema},
          {"status", to_string(id.status)},
          {"reason", id.reason},
          {"method", to_string(id.method)},
          {"base_parameters", list_of<Json>(id.base_parameters, parameter)},
          {"physical_parameters", list_of<Json>(id.physical_parameters, parameter)},
          {"condition_number", number_or_null(id.condition_number)},
          {"residual_rms", numbers_or_null(id.residual_rms)},
          {"fit_r2", numbers_or_null(id.fit_r2)},
          {"held_out_r2", numbers_or_null(id.held_out_r2)},
          {"terms", list_of<Json>(id.terms, term_json)},
          {"torque_delay_s", numbers_or_null(id.torque_delay_s)},
          {"between_logs_std", numbers_or_null(id.between_logs_std)},
          {"q_noise", numbers_or_null(id.q_noise)},
          {"dq_noise", numbers_or_null(id.dq_noise)},
          {"logs", list_of<Json>(id.logs, log_json)}};
}

nlohmann::ordered_json to_json(const Identification& id) {
  nlohmann::ordered_json json = summary_to_json(id);
  add_verdicts(id, json);
  json["state"] = state_json(id);
  return json;
}

namespace {

template <typename Read>
Identification checked(const Json& document, const std::string& where, Read read_document) {
  if (!document.is_object() || document.value("schema", "") != kSchema)
    throw Error(ErrorCode::input, where,
                fmt::format("is not an identification of schema {}; identify again", kSchema));
  try {
    return read_document(document, where);
  } catch (const nlohmann::json::exception& e) {
    throw Error(ErrorCode::input, where, fmt::format("is incomplete ({}); identify again", e.what()));
  }
}

}  // namespace

Identification identification_from_json(const nlohmann::ordered_json& document, const std::string& where) {
  return checked(document, where, read);
}

Identification summary_from_json(const nlohmann::ordered_json& document, const std::string& where) {
  return checked(document, where, read_summary);
}

}  // namespace faultline
