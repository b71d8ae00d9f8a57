// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lib/core/joint.hpp"

/// Cells of the comma-separated tables that faultline writes (RFC 4180).
namespace faultline {

/// Whether a spreadsheet would interpret the text as a formula, or as the beginning of one.
bool begins_like_formula(std::string_view text);
/// Returns text on one line that a spreadsheet shows and does not run: printable(), after an apostrophe if it
/// begins like a formula (=, +, -, @) and is not a number.
std::string inert_text(const std::string& text);
/// Returns the same with its line breaks, in quotes if it contains one, a comma, a quote, or a semicolon
/// before the beginning of a formula.
std::string csv_cell(const std::string& text);
/// Returns the number with every bit; empty if not finite.
std::string csv_cell(double value);
/// Returns the number of a joint; empty for none.
std::string csv_joint(Joint joint);

}  // namespace faultline
