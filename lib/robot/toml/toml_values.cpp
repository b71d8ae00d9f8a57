// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_values.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

namespace faultline {

Eigen::Vector3d vector3(const TomlTable& table, const std::string& key, const Eigen::Vector3d& fallback) {
  if (!table.has(key)) return fallback;
  const auto values = table.numbers(key, 3);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d unit_vector(const TomlTable& table, const std::string& key, const Eigen::Vector3d& fallback) {
  const Eigen::Vector3d v = vector3(table, key, fallback);
  if (v.norm() < 1e-9) table.fail(key, "expected a direction, found a vector of length zero");
  return std::abs(v.norm() - 1.0) < 1e-12 ? v : v.normalized();
}

Eigen::Matrix3d inertia_tensor(const TomlTable& table, const std::string& key) {
  const auto v = table.numbers(key, -1);
  if (v.size() != 3 && v.size() != 6)
    table.fail(key,
               fmt::format("expected [xx, yy, zz] or [xx, yy, zz, xy, xz, yz], found {} numbers", v.size()));
  Eigen::Matrix3d m = Eigen::Vector3d(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    m(0, 1) = m(1, 0) = v[3];
    m(0, 2) = m(2, 0) = v[4];
    m(1, 2) = m(2, 1) = v[5];
  }
  return m;
}

double not_negative(const TomlTable& table, const std::string& key, double fallback) {
  const double value = table.number(key, fallback);
  if (value < 0.0) table.fail(key, fmt::format("expected a number that is not negative, found {}", value));
  return value;
}

double positive(const TomlTable& table, const std::string& key, double fallback) {
  const double value = table.number(key, fallback);
  if (value <= 0.0) table.fail(key, fmt::format("expected a positive number, found {}", value));
  return value;
}

void check_signs(const TomlTable& table, const std::string& key, const std::vector<double>& values,
                 bool zero_allowed) {
  for (const double v : values)
    if (v < 0.0 || (v == 0.0 && !zero_allowed))
      table.fail(key,
                 fmt::format("expected {} numbers, found {}", zero_allowed ? "non-negative" : "positive", v));
}

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
