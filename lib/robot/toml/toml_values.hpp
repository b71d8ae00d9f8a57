// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/robot/toml/toml_table.hpp"

/// Values of option files with a meaning in mechanics. The readers fail as TomlTable does; what is written
/// loads again as the same bits.
namespace faultline {

/// Three numbers, or `fallback` if the key is absent.
Eigen::Vector3d vector3(const TomlTable& table, const std::string& key, const Eigen::Vector3d& fallback);
/// A vector of length 1, or `fallback` if the key is absent.
Eigen::Vector3d unit_vector(const TomlTable& table, const std::string& key, const Eigen::Vector3d& fallback);
/// [xx, yy, zz] or [xx, yy, zz, xy, xz, yz].
Eigen::Matrix3d inertia_tensor(const TomlTable& table, const std::string& key);
double not_negative(const TomlTable& table, const std::string& key, double fallback);
double positive(const TomlTable& table, const std::string& key, double fallback);
/// Fails if one of the numbers under `key` is negative, or zero without `zero_allowed`.
void check_signs(const TomlTable& table, const std::string& key, const std::vector<double>& values,
                 bool zero_allowed);

/// Shortest text of a finite number.
std::string toml_number(double value);
/// A list of numbers.
std::string toml_numbers(const Eigen::Ref<const Eigen::VectorXd>& values);
/// A text in quotes.
std::string toml_quoted(const std::string& text);
/// [xx, yy, zz, xy, xz, yz] of a symmetric matrix.
std::string toml_tensor(const Eigen::Matrix3d& m);

}  // namespace faultline
