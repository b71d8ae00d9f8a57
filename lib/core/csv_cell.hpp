// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Cells of the comma-separated tables we write (RFC 4180).
namespace faultline {

/// In quotes when it holds a comma, a quote or a line break.
std::string csv_cell(const std::string& text);
/// With every bit; empty when not finite.
std::string csv_cell(double value);
/// Empty unless at least 1: joints count from 1, 0 is none.
std::string csv_joint(int joint);

}  // namespace faultline
