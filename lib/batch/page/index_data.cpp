// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "lib/batch/page/index_page.hpp"
#include "lib/batch/page/packed.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr int kDigits = 4;       // of values, as many as a reader can use
constexpr int kTimeDigits = 16;  // of times, which may count from 1970
constexpr std::size_t kLongestText = 400;
constexpr std::size_t kPartRows = 4000;  // unpacked in some 50 ms, between which the page answers

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

template <typename Items, typename Text>
std::string object(const Items& items, Text text) {
  std::string all = list(items, text);
  all.front() = '{';
  all.back() = '}';
  return all;
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

/// Of a list of numbers by joint, a column for each joint; null in a row without the joint.
std::string joint_columns(std::span<const BatchRow> rows, std::vector<double> BatchRow::*values) {
  std::size_t joints = 0;
  for (const BatchRow& row : rows) joints = std::max(joints, (row.*values).size());
  std::string all = "[";
  for (std::size_t j = 0; j < joints; ++j)
    all += (j > 0 ? "," : "") + list(rows, [&](const BatchRow& row) {
             return j < (row.*values).size() ? number((row.*values)[j]) : std::string("null");
           });
  return all + "]";
}

/// Of named values, two columns for each name, by its place: the value, and half of its 95 % interval.
std::string named_columns(std::span<const BatchRow> rows, std::vector<ParameterValue> BatchRow::*values,
                          Places& names) {
  std::map<std::string, std::vector<const ParameterValue*>> found;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const ParameterValue& p : rows[i].*values) {
      auto& all = found[p.name];
      all.resize(rows.size(), nullptr);
      all[i] = &p;
    }
  return object(found, [&](const auto& named) {
    const auto& [name, all] = named;
    return fmt::format("\"{}\":[{},{}]", names.place(name, [&] { return shown(name); }),
                       list(all, [](auto* p) { return p ? number(p->value, kDigits + 2) : "null"; }),
                       list(all, [](auto* p) { return p ? number(kNormal95 * p->std) : "null"; }));
  });
}

/// [row, label, joint, onset_s, alarm_s, end_s, confidence] for each fault; rows count from 0 in each part.
/// A kind of fault is in the list of labels in the words of programs and of people.
std::string faults_of(std::span<const BatchRow> rows, Places& labels) {
  std::string all;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const FaultEvent& fault : rows[i].faults) {
      const FaultLabel& label = fault.label;
      const int place = labels.place(fmt::format("{} {}", to_string(label.kind), label.joint), [&] {
        return fmt::format("[{},{}]", quoted(to_string(label.kind)), quoted(plain_words(label)));
      });
      all += fmt::format("{}[{},{},{},{},{},{},{}]", all.empty() ? "" : ",", i, place, label.joint,
                         number(fault.onset_s, kTimeDigits), number(fault.alarm_s, kTimeDigits),
                         number(fault.end_s, kTimeDigits), number(fault.confidence));
    }
  return "[" + all + "]";
}

std::string part_json(std::span<const BatchRow> rows, IndexNames& names) {
  std::string text = "{";
  const auto put = [&](const char* name, const std::string& value) {
    text += fmt::format("{}\"{}\":{}", text.size() > 1 ? "," : "", name, value);
  };
  const auto text_column = [&](const char* name, auto value) {
    put(name, list(rows, [&](const BatchRow& row) { return shown(value(row)); }));
  };
  const auto number_column = [&](const char* name, auto value, int digits = kDigits) {
    put(name, list(rows, [&](const BatchRow& row) { return number(double(value(row)), digits); }));
  };
  text_column("log", [](const BatchRow& row) { return row.log; });
  text_column("verdict", [](const BatchRow& row) { return row.verdict; });
  text_column("result", [](const BatchRow& row) { return row.result; });
  text_column("reason", [](const BatchRow& row) {
    return row.verdict == "healthy" || !row.faults.empty() ? std::string() : row.reason;
  });
  text_column("doubt", [](const BatchRow& row) { return row.doubt; });
  number_column("model", [&](const BatchRow& row) {
    const auto model = names.models.find(row.model_sha256);
    return model == names.models.end() ? 0 : model->second;
  });
  number_column(
      "start", [](const BatchRow& row) { return row.start_s; }, kTimeDigits);
  number_column(
      "end", [](const BatchRow& row) { return row.end_s; }, kTimeDigits);
  number_column("period", [](const BatchRow& row) { return row.sample_period_s; });
  number_column("joints", [](const BatchRow& row) { return row.joints; });
  number_column("issues", [](const BatchRow& row) { return row.warnings + row.severe; });
  number_column(
      "count", [](const BatchRow& row) { return row.rows; }, kTimeDigits);
  put("rms", joint_columns(rows, &BatchRow::residual_rms));
  put("peak", joint_columns(rows, &BatchRow::residual_peak));
  put("condition", named_columns(rows, &BatchRow::condition, names.parameters));
  put("parameters", named_columns(rows, &BatchRow::parameters, names.parameters));
  put("faults", faults_of(rows, names.labels));
  return text + "}";
}

}  // namespace

IndexData index_data(const std::vector<BatchRow>& rows, const BatchFacts& facts, bool pages) {
  IndexNames names;
  for (const ModelFacts& model : facts.models)
    names.models.try_emplace(model.sha256, static_cast<int>(names.models.size()));
  IndexData data;
  const std::span<const BatchRow> all = rows;
  const std::size_t first = std::min(kIndexFirstRows, rows.size());
  const std::string first_part = part_json(all.first(first), names);
  for (std::size_t from = first; from < rows.size(); from += kPartRows)
    data.parts.push_back(
        packed(part_json(all.subspan(from, std::min(kPartRows, rows.size() - from)), names)));
  const std::string models = list(facts.models, [](const ModelFacts& m) { return shown(m.name); });
  data.facts = inside_script(
      inert_json(fmt::format("{{\"pages\":{},\"time\":{},\"logs\":{},\"models\":{},\"labels\":{},"
                             "\"parameters\":{},\"first\":{}}}",
                             pages, all_have_dates(rows), rows.size(), models, names.labels.json(),
                             names.parameters.json(), first_part)));
  return data;
}

}  // namespace faultline
