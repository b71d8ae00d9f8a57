// SPDX-License-Identifier: MIT
#include "formats/numpy/python_literal.hpp"

#include <cctype>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace faultline {
namespace {

using NpyJson = nlohmann::json;

constexpr int kLiteralDeepest = 16;

class PythonParser {
 public:
  explicit PythonParser(std::string_view text) : text_(text) {}

  std::optional<NpyJson> run() {
    NpyJson value = read(0);
    return failed_ ? std::nullopt : std::optional(value);
  }

 private:
  NpyJson fail() {
    failed_ = true;
    return {};
  }

  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(std::string_view word) {
    peek();
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  NpyJson read(int depth) {
    if (depth > kLiteralDeepest) return fail();
    const char c = peek();
    if (c == '{') return read_dictionary(depth);
    if (c == '[') return read_list(depth, ']');
    if (c == '(') return read_list(depth, ')');
    if (c == '\'' || c == '"') return read_string();
    if ((c == 'u' || c == 'b') && at_ + 1 < text_.size() &&
        (text_[at_ + 1] == '\'' || text_[at_ + 1] == '"')) {
      ++at_;
      return read_string();
    }
    if (take("True")) return true;
    if (take("False")) return false;
    if (take("None")) return nullptr;
    return read_number();
  }

  NpyJson read_dictionary(int depth) {
    NpyJson all = NpyJson::object();
    ++at_;
    while (!failed_ && !take("}")) {
      const NpyJson key = read(depth + 1);
      if (!key.is_string() || !take(":")) return fail();
      all[key.get<std::string>()] = read(depth + 1);
      if (!take(",") && peek() != '}') return fail();
    }
    return all;
  }

  NpyJson read_list(int depth, char close) {
    NpyJson all = NpyJson::array();
    ++at_;
    while (!failed_ && !take(std::string_view(&close, 1))) {
      all.push_back(read(depth + 1));
      if (!take(",") && peek() != close) return fail();
    }
    return all;
  }

  NpyJson read_string() {
    const char quote = text_[at_++];
    std::string text;
    for (; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      text += text_[at_];
    }
    if (at_ == text_.size()) return fail();
    ++at_;
    return text;
  }

  NpyJson read_number() {
    std::int64_t value = 0;
    const std::size_t before = at_;
    for (; at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])); ++at_) {
      if (value > (std::numeric_limits<std::int64_t>::max() - 9) / 10) return fail();
      value = 10 * value + (text_[at_] - '0');
    }
    if (at_ == before) return fail();
    take("L");  // of Python 2
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace

std::optional<nlohmann::json> read_python_literal(std::string_view text) { return PythonParser(text).run(); }

}  // namespace faultline
