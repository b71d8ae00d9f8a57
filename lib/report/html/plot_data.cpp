// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/page_figures.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;
constexpr double kSteps = 65534.0;
constexpr unsigned kMissing = 65535;

/// Magnitudes over several decades are stored by their logarithm, so that small ones keep their digits.
bool is_logarithmic(const std::string& key) { return key.front() == 'r'; }

Json quantised(const std::vector<float>& values, bool logarithmic) {
  std::vector<double> scaled;
  double low = INFINITY, high = -INFINITY;
  for (const float value : values) {
    scaled.push_back(logarithmic ? elementary::log10(std::max<double>(value, 1e-6)) : value);
    if (!std::isfinite(value)) scaled.back() = NAN;
    low = std::fmin(low, scaled.back());
    high = std::fmax(high, scaled.back());
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  const double per_value = high > low ? kSteps / (high - low) : 0.0;
  for (const double value : scaled) {
    const unsigned code =
        std::isnan(value) ? kMissing : static_cast<unsigned>(std::lround((value - low) * per_value));
    bytes.push_back(static_cast<std::uint8_t>(code & 255));
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
  }
  return Json::array({low <= high ? Json(low) : Json(0), low <= high ? Json(high) : Json(0), base64(bytes)});
}

void put(Json& keys, const std::string& key, const std::vector<float>& values) {
  if (!values.empty()) keys[key] = quantised(values, is_logarithmic(key));
}

Json window_json(const CurveWindow& window) {
  Json keys = Json::object();
  for (int j = 0; j < std::ssize(window.joints); ++j) {
    const std::string n = fmt::format("{}", Joint::at(j));
    const JointCurves& joint = window.joints[j];
    put(keys, "r" + n, joint.residual);
    put(keys, "q" + n, joint.q.values);
    put(keys, "q" + n + "h", joint.q_predicted.values);
    put(keys, "dq" + n, joint.dq.values);
    put(keys, "dq" + n + "h", joint.dq_predicted.values);
    put(keys, "tau" + n, joint.tau.values);
    put(keys, "tau" + n + "h", joint.tau_required.values);
  }
  for (std::size_t i = 0; i < window.networks.size(); ++i) {
    const std::string key = "n" + std::to_string(window.fault_id) + "-" + std::to_string(i);
    put(keys, key + "m", window.networks[i].mlp.values);
    put(keys, key + "r", window.networks[i].rbfn.values);
  }
  return {
      {"fault", window.fault_id}, {"from", window.start_s}, {"to", window.end_s}, {"keys", std::move(keys)}};
}

double short_number(double value) { return std::round(value * 1000.0) / 1000.0; }

Json trace_json(const FaultFinding& fault) {
  Json keys = Json::object();
  for (std::size_t i = 0; i < fault.trace.curves.size(); ++i)
    keys["e" + std::to_string(fault.id) + "-" + std::to_string(i)] = list_of<Json>(
        fault.trace.curves[i].ratio, [](double ratio) { return number_or_null(short_number(ratio)); });
  return {{"times", fault.trace.time}, {"keys", std::move(keys)}};
}

Json figure_json(const PageFigure& figure) {
  return {
      {"id", figure.id},
      {"fault", figure.fault_id},
      {"group", figure.group},
      {"log", figure.log_y},
      {"from", figure.from_s},
      {"to", figure.to_s},
      {"least", number_or_null(figure.least_y)},
      {"curves", list_of<Json>(figure.curves,
                               [](const FigureCurve& curve) {
                                 return Json::array({valid_utf8(curve.name), curve.key, curve.pen});
                               })},
      {"limits", list_of<Json>(figure.limits, [](const FigureLimit& limit) { return Json(limit.value); })},
      {"marks", list_of<Json>(figure.marks, [](const PlotMark& mark) {
         return Json::array({mark.x, mark.text});
       })}};
}

}  // namespace

std::string html_plot_data(const std::vector<FaultFinding>& faults, const RunCurves& curves,
                           const std::vector<PageFigure>& figures) {
  Json json = {{"windows", Json::array()}, {"traces", Json::array()}, {"figures", Json::array()}};
  json["windows"].push_back(window_json(curves.whole));
  for (const CurveWindow& window : curves.details) json["windows"].push_back(window_json(window));
  for (const CurveWindow& window : curves.details)
    for (const FaultFinding& fault : faults)
      if (fault.id == window.fault_id) json["traces"].push_back(trace_json(fault));
  for (const PageFigure& figure : figures) json["figures"].push_back(figure_json(figure));
  return inside_script(json.dump());
}

}  // namespace faultline
