// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "lib/batch/page/index_page.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr int kDigits = 4;       // of values, as many as a reader can use
constexpr int kTimeDigits = 16;  // of times, which may count from 1970
constexpr std::size_t kLongestText = 400;

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string shown(const std::string& text) { return quoted(printable(text).substr(0, kLongestText)); }

std::string number(double value, int digits = kDigits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

template <typename Items, typename Text>
std::string list(const Items& items, Text text) {
  std::string all = "[";
  for (const auto& item : items) all += (all.size() > 1 ? "," : "") + text(item);
  return all + "]";
}

/// Values that rows name by their place in a list.
class Places {
 public:
  /// `value` gives what stands in the list for `key`, as JSON.
  template <typename Value>
  int place(const std::string& key, Value value) {
    const auto [found, fresh] = places_.try_emplace(key, static_cast<int>(values_.size()));
    if (fresh) values_.push_back(value());
    return found->second;
  }
  std::string json() const { return fmt::format("[{}]", fmt::join(values_, ",")); }

 private:
  std::map<std::string, int> places_;
  std::vector<std::string> values_;
};

struct IndexNames {
  Places parameters, labels;
  std::map<std::string, int> models;  ///< by hash
};

/// A kind of fault stands there in the words of programs and of people.
std::string faults_json(const std::vector<FaultEvent>& faults, Places& labels) {
  return list(faults, [&](const FaultEvent& fault) {
    const FaultLabel& label = fault.label;
    const int place = labels.place(fmt::format("{} {}", to_string(label.kind), label.joint), [&] {
      return fmt::format("[{},{}]", quoted(to_string(label.kind)), quoted(plain_words(label)));
    });
    return fmt::format("[{},{},{},{},{},{}]", place, label.joint, number(fault.onset_s, kTimeDigits),
                       number(fault.alarm_s, kTimeDigits), number(fault.end_s, kTimeDigits),
                       number(fault.confidence));
  });
}

std::string parameters_json(const std::vector<ParameterValue>& values, Places& names) {
  return list(values, [&](const ParameterValue& p) {
    return fmt::format("[{},{},{}]", names.place(p.name, [&] { return shown(p.name); }),
                       number(p.value, kDigits + 2), number(kNormal95 * p.std));
  });
}

std::string numbers(const std::vector<double>& values) {
  return list(values, [](double value) { return number(value); });
}

std::string row_json(const BatchRow& row, IndexNames& names) {
  const auto model = names.models.find(row.model_sha256);
  return fmt::format(
      "[{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}]", shown(row.log), quoted(row.verdict),
      model == names.models.end() ? 0 : model->second, quoted(row.result),
      faults_json(row.faults, names.labels),
      row.verdict == "healthy" || !row.faults.empty() ? "\"\"" : shown(row.reason),
      number(row.start_s, kTimeDigits), number(row.end_s, kTimeDigits), number(row.sample_period_s),
      row.joints, row.warnings + row.severe, row.rows, numbers(row.residual_rms), numbers(row.residual_peak),
      parameters_json(row.condition, names.parameters), parameters_json(row.parameters, names.parameters),
      row.doubt.empty() ? "\"\"" : shown(row.doubt));
}

}  // namespace

std::string index_data(const std::vector<BatchRow>& rows, const BatchFacts& facts, bool pages) {
  IndexNames names;
  for (const ModelFacts& model : facts.models)
    names.models.try_emplace(model.sha256, static_cast<int>(names.models.size()));
  const std::string body = list(rows, [&](const BatchRow& row) { return row_json(row, names) + "\n"; });
  const std::string models = list(facts.models, [](const ModelFacts& m) { return shown(m.name); });
  return inside_script(inert_json(
      fmt::format("{{\"pages\":{},\"time\":{},\"models\":{},\"labels\":{},\"parameters\":{},\"rows\":{}}}",
                  pages, all_have_dates(rows), models, names.labels.json(), names.parameters.json(), body)));
}

}  // namespace faultline
