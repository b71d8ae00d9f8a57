// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

/// Values as TOML that loads again as the same bits.
namespace faultline {

/// Shortest text of a finite number.
std::string toml_number(double value);
/// A list of numbers.
std::string toml_numbers(const Eigen::Ref<const Eigen::VectorXd>& values);
/// A text in quotes.
std::string toml_quoted(const std::string& text);
/// [xx, yy, zz, xy, xz, yz] of a symmetric matrix.
std::string toml_tensor(const Eigen::Matrix3d& m);

}  // namespace faultline
