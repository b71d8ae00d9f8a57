// SPDX-License-Identifier: MIT
#include "lib/html/elements.hpp"

#include <fmt/format.h>

#include "lib/core/markup.hpp"

namespace faultline {

std::string html_table(const HtmlRow& head, const std::vector<HtmlRow>& rows) {
  if (rows.empty()) return "";
  std::string text = "<div class=\"wide\"><table>\n";
  if (!head.empty()) {
    text += "<thead><tr>";
    for (const std::string& cell : head) text += "<th scope=\"col\">" + escaped_markup(cell) + "</th>";
    text += "</tr></thead>\n";
  }
  text += "<tbody>\n";
  for (const HtmlRow& row : rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool heads = head.empty() && i == 0;
      text += (heads ? "<th scope=\"row\">" : "<td>") + escaped_markup(row[i]) + (heads ? "</th>" : "</td>");
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string html_table(const FactTable& table) {
  return html_part(table.title.c_str(), html_table(table.head, table.rows));
}

std::string html_list(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "<li>" + escaped_markup(line) + "</li>\n";
  return text.empty() ? "" : "<ul>\n" + text + "</ul>\n";
}

std::string html_part(const char* title, const std::string& content) {
  return content.empty() ? "" : fmt::format("<h3>{}</h3>\n{}", escaped_markup(title), content);
}

}  // namespace faultline
