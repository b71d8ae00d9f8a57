// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace faultline {

/// A figure of each experiment (one a seed), or a single one that was printed elsewhere or pooled over seeds.
/// NaN where an experiment gave none.
struct Measured {
  std::vector<double> by_seed;

  double mean() const;    ///< over the seeds that gave a number; NaN if none did
  double spread() const;  ///< standard deviation over those seeds; NaN for fewer than two
};

enum class FigureStyle {
  scientific,  ///< 3.4e-3
  percent,     ///< a share 0 to 1, written as 99.7 %
  decimal,     ///< three significant digits
};

struct FigureColumn {
  std::string name;
  std::string unit{};
  FigureStyle style = FigureStyle::scientific;
};

struct ResultRow {
  std::vector<std::string> labels;               ///< one a label column
  std::vector<std::optional<Measured>> figures;  ///< one a figure column; empty = does not apply
};

/// A table of results: what was varied, and what came out.
struct ResultTable {
  std::string id;     ///< stable name in JSON, such as "table_2"
  std::string title;  ///< one line
  std::string text;   ///< what was done and how to read it; Markdown paragraphs, may be empty
  std::vector<std::string> label_columns;
  std::vector<FigureColumn> figure_columns;
  std::vector<ResultRow> rows;
};

/// A number this project set out to reach, and whether it was.
struct Goal {
  std::string what;   ///< with controller and noise reading
  std::string paper;  ///< the paper's figure as printed, "-" if none
  std::string study;  ///< that of an independent study, "-" if none
  double bound = 0.0;
  bool at_most = true;  ///< the mean must not be above `bound`; else not below
  Measured measured;
  FigureStyle style = FigureStyle::scientific;
  std::string unit{};
  std::string note{};  ///< what bounds it where it is not reached

  bool reached() const;  ///< of the mean over seeds
};

struct StudyResult {
  std::vector<ResultTable> tables;
  std::vector<Goal> goals;
};

/// "3.4e-3", "99.70 %" or "0.15" by the style; "-" for NaN.
std::string figure_text(double value, FigureStyle style);
/// The mean, and ± the spread where there is one.
std::string figure_text(const Measured& measured, FigureStyle style);

}  // namespace faultline
