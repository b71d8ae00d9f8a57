// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/report/fact_table.hpp"
#include "lib/report/plot/line_plot.hpp"

/// Pieces of a page; every text is escaped.
namespace faultline {

using HtmlRow = std::vector<std::string>;

/// How a table of so many columns stands where it has no room (style/tables.css): ` class="few"`, as cards on
/// a phone; ` class="many"`, on a tablet too; empty for one that always has room.
const char* html_table_class(std::size_t columns);

/// Empty without rows; without `head`, the first cell of each row is its heading. `caption` is for screen
/// readers: on the screen a heading says it.
std::string html_table(const HtmlRow& head, const std::vector<HtmlRow>& rows,
                       const std::string& caption = "");
/// With its title as heading and caption.
std::string html_table(const FactTable& table);
/// Empty without lines.
std::string html_list(const std::vector<std::string>& lines);
/// A heading over `content`, none when the title is empty; empty without content.
std::string html_part(const char* title, const std::string& content);

/// A picture of a page without scripts.
struct NamedPlot {
  std::string name;  ///< of its own on the page, fit to be a file's
  LinePlot plot;
};

/// An item of a legend: a line of this pen, then `html`.
std::string legend_item(const PlotPen& pen, const std::string& html);

/// Pictures with caption and legend, for a page without scripts; empty without plots.
std::string still_figures(const std::vector<NamedPlot>& plots);

/// RFC 4648 with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// As Content-Security-Policy names an inline script or style: "'sha256-...'".
std::string source_hash(std::string_view content);

/// From the doctype to </head>: title, styles, and a policy that allows nothing but them and, with
/// `with_script`, its scripts.
std::string html_head(const std::string& title, bool with_script);

// Files that are put into every page, embedded when the program is built (embed_assets.cmake).
std::string_view dygraphs_script();  ///< dygraph.min.js of Debian's libjs-dygraphs
std::string_view dygraphs_style();
std::string_view page_script();
std::string_view page_style();

}  // namespace faultline
