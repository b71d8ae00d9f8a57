// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/nearest_word.hpp"

namespace faultline {
namespace {

const toml::table& empty_table() {
  static const toml::table table;
  return table;
}

/// Returns a value as messages quote it.
std::string shown(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>)
      out << value;
    else if constexpr (toml::is_array<decltype(value)>)
      out << "a list";
    else
      out << "a table";
  });
  return out.str();
}

/// A position in a text; line and column count from 1.
struct DeepPlace {
  int line = 1;
  int column = 1;
};

constexpr int kMostTomlNesting = 16;  ///< brackets within brackets, or dots in one key

/// Returns the position after the quoted text that begins at `at`. A quote that is not closed ends with its
/// line, an open triple quote with the text.
std::size_t after_quotes(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool long_text = toml.substr(at, 3) == three;
  for (at += long_text ? 3 : 1; at < toml.size(); ++at) {
    if (toml[at] == '\\' && quote == '"') {
      ++at;
    } else if (long_text && toml.substr(at, 3) == three) {
      at += 3;
      for (int i = 0; i < 2 && at < toml.size() && toml[at] == quote; ++i)
        ++at;  // belongs to the text, before the closing quotes
      return at;
    } else if (!long_text && (toml[at] == quote || toml[at] == '\n')) {
      return at + (toml[at] == quote);
    }
  }
  return toml.size();
}

DeepPlace place_of(std::string_view toml, std::size_t at) {
  const std::string_view before = toml.substr(0, at);
  const auto line_begin = before.rfind('\n') + 1;  // 0 if there is no line break before
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(at - line_begin) + 1};
}

/// Returns the first position at which a TOML text nests brackets, or has dots in one key, deeper than
/// kMostTomlNesting; empty if there is none. Call it before parsing: the TOML library recurses for each level
/// of a key.
std::optional<DeepPlace> too_deep(std::string_view toml) {
  int open = 0, dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '"' || c == '\'') {
      at = after_quotes(toml, at);
      continue;
    }
    if (c == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') open = std::max(open - 1, 0);
    if (c == '.') ++dots;
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}') dots = 0;
    if (open > kMostTomlNesting || dots > kMostTomlNesting) return place_of(toml, at);
    ++at;
  }
  return std::nullopt;
}

}  // namespace

struct TomlTable::Data {
  std::shared_ptr<const toml::table> root;  ///< keeps the nodes alive
  const toml::table* table = nullptr;
  std::string where;   ///< the file
  std::string prefix;  ///< "log.columns." for the keys of [log.columns]
  std::set<std::string> asked;
  std::vector<std::shared_ptr<Data>> children;

  const toml::node* find(const std::string& key);
  /// Returns the value of a key; fails with `expected` in the message if the key is absent.
  const toml::node& required(const std::string& key, const char* expected);
  /// Returns the finite number in `node`; otherwise fails with the value found.
  double as_number(const std::string& key, const toml::node& node) const;
  std::shared_ptr<Data> child(const toml::table& of, const std::string& name);
  std::string place(const std::string& key) const;
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
};

const toml::node* TomlTable::Data::find(const std::string& key) {
  asked.insert(key);
  return table->get(key);
}

const toml::node& TomlTable::Data::required(const std::string& key, const char* expected) {
  if (const toml::node* node = find(key)) return *node;
  std::vector<std::string> present;
  for (const auto& [name, node] : *table) present.emplace_back(name.str());
  const std::string near = nearest_word(key, present);
  fail("", fmt::format("the key {}{} is missing; expected {}{}", prefix, key, expected,
                       near.empty() ? "" : fmt::format(". Is \"{}\" a misspelling of it?", near)));
}

double TomlTable::Data::as_number(const std::string& key, const toml::node& node) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value))
    fail(key, fmt::format("expected a finite number, found {}", shown(node)));
  return *value;
}

std::shared_ptr<TomlTable::Data> TomlTable::Data::child(const toml::table& of, const std::string& name) {
  auto data = std::make_shared<Data>(Data{root, &of, where, prefix + name + ".", {}, {}});
  children.push_back(data);
  return data;
}

std::string TomlTable::Data::place(const std::string& key) const {
  const toml::node* node = key.empty() ? table : table->get(key);
  const auto line = (node ? node : table)->source().begin.line;
  std::string name = prefix + key;
  if (key.empty() && !name.empty()) name.pop_back();  // the table itself
  return where + (line ? fmt::format(", line {}", line) : "") + (name.empty() ? "" : ", key " + name);
}

void TomlTable::Data::fail(const std::string& key, const std::string& message) const {
  throw Error(ErrorCode::usage, place(key), message);
}

TomlTable TomlTable::parse(const std::string& text, const std::string& where) {
  if (const auto place = too_deep(text))
    throw Error(ErrorCode::usage, fmt::format("{}, line {}, column {}", where, place->line, place->column),
                fmt::format("is nested deeper than {} levels, which no option file needs", kMostTomlNesting));
  try {
    auto root = std::make_shared<const toml::table>(toml::parse(text));
    return TomlTable(std::make_shared<Data>(Data{root, root.get(), where, "", {}, {}}));
  } catch (const toml::parse_error& error) {
    const auto place = error.source().begin;
    throw Error(ErrorCode::usage, fmt::format("{}, line {}, column {}", where, place.line, place.column),
                fmt::format("is not valid TOML: {}", error.description()));
  }
}

bool TomlTable::has(const std::string& key) const { return data_->find(key) != nullptr; }

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : *data_->table) names.emplace_back(key.str());
  return names;
}

bool TomlTable::is_table(const std::string& key) const {
  return data_->table->get_as<toml::table>(key) != nullptr;
}

bool TomlTable::is_text(const std::string& key) const {
  return data_->table->get_as<std::string>(key) != nullptr;
}

bool TomlTable::is_array(const std::string& key) const {
  return data_->table->get_as<toml::array>(key) != nullptr;
}

double TomlTable::number(const std::string& key) const {
  return data_->as_number(key, data_->required(key, "a number"));
}

double TomlTable::number(const std::string& key, double fallback) const {
  return has(key) ? number(key) : fallback;
}

double TomlTable::any_number(const std::string& key) const {
  const toml::node& node = data_->required(key, "a number");
  if (!node.is_number()) fail(key, fmt::format("expected a number, found {}", shown(node)));
  return *node.value<double>();
}

std::int64_t TomlTable::integer(const std::string& key, std::int64_t fallback) const {
  if (!has(key)) return fallback;
  const toml::node& node = *data_->find(key);
  if (!node.is_integer()) fail(key, fmt::format("expected a whole number, found {}", shown(node)));
  return *node.value<std::int64_t>();
}

bool TomlTable::flag(const std::string& key, bool fallback) const {
  if (!has(key)) return fallback;
  const toml::node& node = *data_->find(key);
  if (!node.is_boolean()) fail(key, fmt::format("expected true or false, found {}", shown(node)));
  return *node.value<bool>();
}

std::string TomlTable::text(const std::string& key) const {
  const toml::node& node = data_->required(key, "a text in quotes");
  if (!node.is_string()) fail(key, fmt::format("expected a text in quotes, found {}", shown(node)));
  return *node.value<std::string>();
}

std::string TomlTable::text(const std::string& key, const std::string& fallback) const {
  return has(key) ? text(key) : fallback;
}

std::string TomlTable::choice(const std::string& key, const std::vector<std::string>& choices) const {
  const std::string value = text(key);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
  const std::string near = nearest_word(value, choices);
  fail(key, fmt::format("expected one of \"{}\", found \"{}\"{}", fmt::join(choices, "\", \""), value,
                        near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

std::vector<double> TomlTable::numbers(const std::string& key, int count) const {
  const std::string expected = count < 0 ? "a list of numbers" : "a list of " + counted(count, "number");
  const toml::node& node = data_->required(key, expected.c_str());
  const toml::array* list = node.as_array();
  if (!list) fail(key, fmt::format("expected {}, found {}", expected, shown(node)));
  if (count >= 0 && list->size() != static_cast<std::size_t>(count))
    fail(key, fmt::format("expected {}, found {} of them", expected, list->size()));
  std::vector<double> values;
  for (const toml::node& item : *list) values.push_back(data_->as_number(key, item));
  return values;
}

std::vector<std::vector<double>> TomlTable::number_rows(const std::string& key, int count) const {
  const std::string expected = fmt::format("a list of lists of {} numbers", count);
  const toml::node& node = data_->required(key, expected.c_str());
  std::vector<std::vector<double>> rows;
  if (!node.is_array()) fail(key, fmt::format("expected {}, found {}", expected, shown(node)));
  for (const toml::node& row : *node.as_array()) {
    if (!row.is_array() || row.as_array()->size() != static_cast<std::size_t>(count))
      fail(key, fmt::format("expected {}, found another row in it", expected));
    rows.emplace_back();
    for (const toml::node& item : *row.as_array()) rows.back().push_back(data_->as_number(key, item));
  }
  return rows;
}

std::vector<double> TomlTable::each(const std::string& key, int count) const {
  if (is_array(key)) return numbers(key, count);
  return std::vector<double>(count, number(key));
}

std::vector<std::string> TomlTable::texts(const std::string& key) const {
  const toml::node& node = data_->required(key, "a list of texts in quotes");
  if (!node.is_array()) fail(key, fmt::format("expected a list of texts, found {}", shown(node)));
  std::vector<std::string> values;
  for (const toml::node& item : *node.as_array()) {
    if (!item.is_string()) fail(key, fmt::format("expected texts in quotes, found {} in it", shown(item)));
    values.push_back(*item.value<std::string>());
  }
  return values;
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  const toml::node* node = data_->find(key);
  std::vector<TomlTable> result;
  if (!node) return result;
  const toml::array* list = node->as_array();
  if (!list) fail(key, fmt::format("expected a list of tables ([[{}]]), found {}", key, shown(*node)));
  for (const toml::node& item : *list) {
    if (!item.is_table())
      fail(key, fmt::format("expected a list of tables ([[{}]]), found {} in it", key, shown(item)));
    result.push_back(
        TomlTable(data_->child(*item.as_table(), fmt::format("{}[{}]", key, result.size() + 1))));
  }
  return result;
}

TomlTable TomlTable::table(const std::string& key) const {
  const toml::node* node = data_->find(key);
  if (node && !node->is_table()) fail(key, fmt::format("expected a table, found {}", shown(*node)));
  return TomlTable(data_->child(node ? *node->as_table() : empty_table(), key));
}

void TomlTable::finish() const {
  const std::vector<std::string> asked(data_->asked.begin(), data_->asked.end());
  for (const std::string& key : keys()) {
    if (data_->asked.count(key)) continue;
    const std::string near = nearest_word(key, asked);
    fail(key, fmt::format("is not a key of this table; {}",
                          !near.empty() ? fmt::format("did you mean \"{}\"?", near)
                                        : fmt::format("expected one of {}", fmt::join(asked, ", "))));
  }
  for (const auto& child : data_->children) TomlTable(child).finish();
}

void TomlTable::fail(const std::string& key, const std::string& message) const { data_->fail(key, message); }

}  // namespace faultline
