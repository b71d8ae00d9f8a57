// SPDX-License-Identifier: MIT
#pragma once

#include <toml++/toml.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "lib/robot/toml/toml_table.hpp"

/// The implementation of TomlTable; for its own sources only.
namespace faultline {

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

/// Returns a value as messages quote it.
std::string shown(const toml::node& node);

}  // namespace faultline
