// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/report/plot/line_plot.hpp"
#include "lib/reproduce/page/result_table.hpp"

namespace faultline {

struct ReproduceOptions {
  int seeds = 5;           ///< experiments, each with its own data and start weights
  std::uint64_t seed = 1;  ///< of the first; the others follow
  bool quick = false;      ///< fewer patterns, runs and hours: orders of magnitude within a minute
  int threads = 0;         ///< 0 = one a core; changes no number

  /// Throws Error(usage) naming the field, its value and its bound.
  void check() const;
};

/// A picture with its stable name, which is also its file's.
struct Figure {
  std::string id;       ///< such as "figure_3"
  std::string caption;  ///< Markdown
  LinePlot plot;
};

/// Section V.A of the paper: how well the fault-free motion is predicted one sample ahead. The paper's
/// network by its own trainer and by Levenberg-Marquardt, its variants, physics and hybrid; tables
/// generator_mse, generator_by_output, generator_friction.
StudyResult generator_study(const ReproduceOptions& options, const Progress& progress = {});

/// The paper's tables 1 and 2: the training set of the classifier of single samples, its errors as the paper
/// built it, what each departure buys, and what the true model could do at best. All three controllers.
StudyResult classifier_study(const ReproduceOptions& options, const Progress& progress = {});

/// The paper's figures 1 and 2 as runs: detection of a free-swinging joint at any time by single networks, by
/// both with a case-based decision, by this project's own way and by a near-optimal reference, under every
/// controller and noise reading.
StudyResult run_study(const ReproduceOptions& options, const Progress& progress = {});

/// The paper's figures 3 to 8: residual, position and velocity of joint 2, which swings freely from 4 s (MLP)
/// or 5 s (RBFN) on, with what the networks put out. Held controller, no noise, the paper's own recipe.
std::vector<Figure> fault_figures(const ReproduceOptions& options);

/// Every table and figure of the paper, beside what it printed, and what each departure from it buys.
struct Reproduction {
  ReproduceOptions options;
  std::vector<ResultTable> tables;
  std::vector<Figure> figures;
  std::vector<Goal> goals;
};

/// Runs the whole reproduction; the same options but `threads` give the same numbers.
Reproduction reproduce(const ReproduceOptions& options = {}, const Progress& progress = {});

/// A page with all of it; pictures are taken from `<id>.svg` beside it.
std::string reproduction_markdown(const Reproduction& reproduction);
/// Schema "faultline/reproduction/1".
std::string reproduction_json(const Reproduction& reproduction);

/// Whether pictures stand for this table on a page: how the criterion's g trades false alarms for delay.
bool is_trade_off(const ResultTable& table);

/// Pictures of the trade-off tables, whose label columns are detector ("recipe, network") and g: one a
/// recipe, the figure columns over g in a panel each, a curve a network.
std::vector<Figure> trade_off_figures(const std::vector<ResultTable>& tables);

}  // namespace faultline
