// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_table_data.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "lib/core/error.hpp"
#include "lib/robot/nearest_word.hpp"

namespace faultline {

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

}  // namespace faultline
