// SPDX-License-Identifier: MIT
#pragma once

#include <toml++/toml.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "lib/robot/toml/toml_table.hpp"

/// What is behind a TomlTable; for its own sources alone.
namespace faultline {

struct TomlTable::Data {
  std::shared_ptr<const toml::table> root;  ///< keeps the nodes alive
  const toml::table* table = nullptr;
  std::string where;   ///< the file
  std::string prefix;  ///< "log.columns." for the keys of [log.columns]
  std::set<std::string> asked;
  std::vector<std::shared_ptr<Data>> children;

  const toml::node* find(const std::string& key);
  /// The value of a key; fails, saying what was `expected`, when there is none.
  const toml::node& required(const std::string& key, const char* expected);
  /// A finite number of that key's value; fails with what it is.
  double as_number(const std::string& key, const toml::node& node) const;
  std::shared_ptr<Data> child(const toml::table& of, const std::string& name);
  std::string place(const std::string& key) const;
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
};

/// A value as messages quote it.
std::string shown(const toml::node& node);

}  // namespace faultline
