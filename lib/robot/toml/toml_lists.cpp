// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lib/core/text.hpp"
#include "lib/robot/toml/toml_table_data.hpp"

namespace faultline {

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

}  // namespace faultline
