// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/reproduce/classifier/classifier_bench.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/result_table.hpp"

namespace faultline {

/// What one experiment (seed) found under one controller.
struct ClassifierFindings {
  std::array<int, kFaultClasses> patterns{};                     ///< of the training set, by class
  std::array<Eigen::VectorXd, kFaultClasses> velocity_residual;  ///< rms by joint, rad/s or m/s
  std::vector<ClassifierErrors> by_recipe;
  std::array<double, 3> posterior{};       ///< mean squared error at each of kNoiseVariants
  std::array<double, 3> posterior_next{};  ///< the torque of the next sample known too; NaN for held
};

/// The findings of all controllers (kControllerVariants) and seeds, as tables and goals.
class ClassifierResults {
 public:
  ClassifierResults(std::vector<ClassifierRecipe> recipes, int seeds);

  /// Where the findings of one item belong.
  ClassifierFindings& at(int controller, int seed) { return findings_[controller * seeds_ + seed]; }
  StudyResult tables_and_goals() const;

 private:
  template <typename Pick>  // from ClassifierFindings to a number
  Measured measured(int controller, const Pick& pick) const {
    Measured all;
    for (int seed = 0; seed < seeds_; ++seed)
      all.by_seed.push_back(pick(findings_[controller * seeds_ + seed]));
    return all;
  }
  ResultRow recipe_row(int controller, int recipe) const;
  ResultRow posterior_row(int controller, bool next_torque) const;
  ResultTable table_1() const;
  ResultTable table_2() const;
  ResultTable departures() const;
  std::vector<Goal> goals() const;

  std::vector<ClassifierRecipe> recipes_;
  int seeds_;
  std::vector<ClassifierFindings> findings_;
};

/// The paper's tables 1 and 2: the training set of the classifier of single samples, its errors as the paper
/// built it, what each departure buys, and what the true model could do at best. All three controllers.
StudyResult classifier_study(const ReproduceOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
