// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lib/core/enum_named.hpp"

namespace faultline {

/// A table of an option file (TOML) that records which keys were asked for, so that finish() can report
/// unknown keys. Every failure throws Error(usage) with file, line, key, what was found and what was
/// expected. Keeps the TOML library out of the headers.
class TomlTable {
 public:
  static TomlTable parse(const std::string& text, const std::string& where);

  bool has(const std::string& key) const;
  /// Returns the keys in alphabetical order; does not record them as asked for.
  std::vector<std::string> keys() const;
  bool is_table(const std::string& key) const;
  bool is_text(const std::string& key) const;
  bool is_array(const std::string& key) const;

  /// A finite number; the second form returns `fallback` if the key is absent.
  double number(const std::string& key) const;
  double number(const std::string& key, double fallback) const;
  /// A number that may be nan or inf.
  double any_number(const std::string& key) const;
  std::int64_t integer(const std::string& key, std::int64_t fallback) const;
  bool flag(const std::string& key, bool fallback) const;
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  /// Exactly `count` finite numbers, or any number of them if `count` is -1.
  std::vector<double> numbers(const std::string& key, int count) const;
  /// A list of lists of `count` numbers each.
  std::vector<std::vector<double>> number_rows(const std::string& key, int count) const;
  /// A list of `count` numbers, or one number that is repeated `count` times.
  std::vector<double> each(const std::string& key, int count) const;
  std::vector<std::string> texts(const std::string& key) const;
  /// One of `choices`.
  std::string choice(const std::string& key, const std::vector<std::string>& choices) const;
  /// The value of `all` whose to_string() is the text.
  template <typename Enum>
  Enum choice_of(const std::string& key, std::initializer_list<Enum> all) const {
    std::vector<std::string> words;
    for (const Enum value : all) words.emplace_back(to_string(value));
    return *enum_named(choice(key, words), all);
  }
  /// An empty table if the key is absent.
  TomlTable table(const std::string& key) const;
  /// A list of tables ([[key]]); empty if the key is absent.
  std::vector<TomlTable> tables(const std::string& key) const;

  /// Throws if the table, or one taken from it, has a key that was never asked for.
  void finish() const;
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  struct Data;
  explicit TomlTable(std::shared_ptr<Data> data) : data_(std::move(data)) {}

  std::shared_ptr<Data> data_;
};

}  // namespace faultline
