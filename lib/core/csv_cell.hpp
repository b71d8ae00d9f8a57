// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

/// Cells of the comma-separated tables we write (RFC 4180).
namespace faultline {

/// Whether a spreadsheet would take the text for a formula, or for the beginning of one.
bool begins_like_formula(std::string_view text);
/// Text on one line that a spreadsheet shows and does not run: printable(), an apostrophe before it when it
/// begins like a formula (=, +, -, @) and is no number.
std::string inert_text(const std::string& text);
/// The same with its line breaks, in quotes when it holds one, a comma, a quote, or a semicolon with the like
/// of a formula behind it.
std::string csv_cell(const std::string& text);
/// With every bit; empty when not finite.
std::string csv_cell(double value);
/// Empty unless at least 1: joints count from 1, 0 is none.
std::string csv_joint(int joint);

}  // namespace faultline
