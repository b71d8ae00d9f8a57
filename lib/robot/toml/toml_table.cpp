// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/robot/nearest_word.hpp"
#include "lib/robot/toml/toml_depth.hpp"
#include "lib/robot/toml/toml_table_data.hpp"

namespace faultline {

namespace {

const toml::table& empty_table() {
  static const toml::table table;
  return table;
}

}  // namespace

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
  const toml::node* node = data_->table->get(key);
  return node && node->is_table();
}
bool TomlTable::is_text(const std::string& key) const {
  const toml::node* node = data_->table->get(key);
  return node && node->is_string();
}
bool TomlTable::is_array(const std::string& key) const {
  const toml::node* node = data_->table->get(key);
  return node && node->is_array();
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
