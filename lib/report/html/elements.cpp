// SPDX-License-Identifier: MIT
#include "lib/report/html/elements.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kFew = 4, kMany = 7;  // columns from which a table needs room
constexpr std::size_t kMostColumns = 10;    // of one that fits on a screen; wider ones are scrolled
constexpr std::size_t kLongestWord = 30;    // letters that stay together

bool has_long_word(const std::string& text) {
  std::size_t length = 0;
  for (const char c : text) {
    length = c == ' ' ? 0 : length + 1;
    if (length > kLongestWord) return true;
  }
  return false;
}

std::string label_attribute(const HtmlRow& head, std::size_t column) {
  if (head.size() < kFew || column >= head.size() || head[column].empty()) return "";
  return fmt::format(" data-label=\"{}\"", escaped_markup(head[column]));
}

std::string cell_text(const HtmlRow& head, const std::string& cell, std::size_t column) {
  if (head.empty() && column == 0) return "<th scope=\"row\">" + escaped_markup(cell) + "</th>";
  return fmt::format("<td{}{}>{}</td>", has_long_word(cell) ? " class=\"any\"" : "",
                     label_attribute(head, column), escaped_markup(cell));
}

/// A table that is wider than screens is a region that the keyboard can scroll.
std::string opening(std::size_t columns, const std::string& caption) {
  if (columns <= kMostColumns) return "<div class=\"wide\">";
  return fmt::format("<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">",
                     escaped_markup(caption.empty() ? "Table" : caption));
}

std::string legend(const LinePlot& plot) {
  std::string text = "<ul class=\"legend\">";
  for (const PlotPanel& panel : plot.panels)
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
      const PlotSeries& series = panel.series[i];
      if (series.name.empty()) continue;
      const PlotPen pen = plot_pen(series.pen < 0 ? i : static_cast<std::size_t>(series.pen));
      text += fmt::format("<li><svg viewBox=\"0 0 28 8\" aria-hidden=\"true\">{}</svg>{}</li>",
                          key_sample(series, pen, 1.0, 4.0), escaped_markup(series.name));
    }
  return text + "</ul>";
}

std::string figure(const NamedPlot& named) {
  LinePlot plot = named.plot;
  plot.id = named.name + "-";
  plot.captions = false;
  return fmt::format("<figure id=\"{}\"><figcaption>{}</figcaption>\n{}\n<div class=\"still\">", named.name,
                     escaped_markup(plot.title), legend(plot)) +
         render_svg(plot) + "</div></figure>\n";
}

std::string policy(bool with_script) {
  std::string scripts = "'none'";
  if (with_script) scripts = source_hash(dygraphs_script()) + " " + source_hash(page_script());
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {} {}; base-uri 'none'; form-action 'none'", scripts,
      source_hash(page_style()), source_hash(dygraphs_style()));
}

}  // namespace

const char* html_table_class(std::size_t columns) {
  return columns >= kMany ? " class=\"many\"" : columns >= kFew ? " class=\"few\"" : "";
}

std::string html_table(const HtmlRow& head, const std::vector<HtmlRow>& rows, const std::string& caption) {
  if (rows.empty()) return "";
  std::string text =
      opening(head.size(), caption) + fmt::format("<table{}>\n", html_table_class(head.size()));
  if (!caption.empty())
    text += fmt::format("<caption><span class=\"unseen\">{}</span></caption>\n", escaped_markup(caption));
  if (!head.empty()) {
    text += "<thead><tr>";
    for (const std::string& cell : head)
      text += cell.empty() ? "<td></td>" : "<th scope=\"col\">" + escaped_markup(cell) + "</th>";
    text += "</tr></thead>\n";
  }
  text += "<tbody>\n";
  for (const HtmlRow& row : rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) text += cell_text(head, row[i], i);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string html_table(const FactTable& table) {
  return html_part(table.title.c_str(), html_table(table.head, table.rows, table.title));
}

std::string html_list(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "<li>" + escaped_markup(line) + "</li>\n";
  return text.empty() ? "" : "<ul>\n" + text + "</ul>\n";
}

std::string html_part(const char* title, const std::string& content) {
  if (content.empty() || *title == '\0') return content;
  return fmt::format("<h3>{}</h3>\n{}", escaped_markup(title), content);
}

std::string legend_item(const PlotPen& pen, const std::string& html) {
  return fmt::format(
      "<li><svg viewBox=\"0 0 28 8\" aria-hidden=\"true\"><line x1=\"0\" x2=\"28\" y1=\"4\" y2=\"4\" "
      "stroke=\"{}\" stroke-width=\"2.4\" stroke-dasharray=\"{}\"/></svg>{}</li>",
      pen.colour, pen.dashes, html);
}

std::string still_figures(const std::vector<NamedPlot>& plots) {
  std::string text;
  for (const NamedPlot& plot : plots) text += figure(plot);
  return text.empty() ? "" : "<div class=\"plots\">\n" + text + "</div>\n";
}

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  std::size_t out = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3, out += 4) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16 |
                                (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0u) |
                                (left > 2 ? bytes[i + 2] : 0u);
    text[out] = kDigits[group >> 18];
    text[out + 1] = kDigits[group >> 12 & 63];
    if (left > 1) text[out + 2] = kDigits[group >> 6 & 63];
    if (left > 2) text[out + 3] = kDigits[group & 63];
  }
  return text;
}

std::string source_hash(std::string_view content) {
  const std::string hex = sha256_hex(content);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return "'sha256-" + base64(bytes) + "'";
}

std::string html_head(const std::string& title, bool with_script) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n",
      policy(with_script), escaped_markup(title));
  if (with_script) text += fmt::format("<style>{}</style>\n", dygraphs_style());
  text += fmt::format("<style>{}</style>\n", page_style());  // after it, so that ours stands
  return text + "</head>\n";
}

}  // namespace faultline
