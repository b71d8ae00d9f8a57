// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/report/plot/line_plot.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// A picture with its stable name, which is also its file's.
struct Figure {
  std::string id;       ///< such as "figure_3"
  std::string caption;  ///< Markdown
  LinePlot plot;
};

/// Every table and figure of the paper, beside what it printed, and what each departure from it buys.
struct Reproduction {
  ReproduceOptions options;
  std::vector<ResultTable> tables;
  std::vector<Figure> figures;
  std::vector<Goal> goals;
};

/// A page with all of it; pictures are taken from `<id>.svg` beside it.
std::string reproduction_markdown(const Reproduction& reproduction);
/// Schema "faultline/reproduction/1".
std::string reproduction_json(const Reproduction& reproduction);

}  // namespace faultline
