// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/report/fact_table.hpp"

/// Pieces of a page; every text is escaped.
namespace faultline {

using HtmlRow = std::vector<std::string>;

/// Empty without rows; without `head`, the first cell of each row is its heading.
std::string html_table(const HtmlRow& head, const std::vector<HtmlRow>& rows);
std::string html_table(const FactTable& table);
/// Empty without lines.
std::string html_list(const std::vector<std::string>& lines);
/// A heading over `content`; empty without content.
std::string html_part(const char* title, const std::string& content);

}  // namespace faultline
