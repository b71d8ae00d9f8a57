// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_text.hpp"

#include <fmt/format.h>

namespace faultline {

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_numbers(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string text = "[";
  for (int i = 0; i < static_cast<int>(values.size()); ++i) text += (i ? ", " : "") + toml_number(values[i]);
  return text + "]";
}

std::string toml_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

std::string toml_tensor(const Eigen::Matrix3d& m) {
  Eigen::Matrix<double, 6, 1> values;
  values << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2);
  return toml_numbers(values);
}

}  // namespace faultline
