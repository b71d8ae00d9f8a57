// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string>

#include "lib/reproduce/classifier/classifier_results.hpp"

namespace faultline {
namespace {

constexpr int kHeld = 0, kFast = 1, kPd = 2;  // places in kControllerVariants

}  // namespace

std::vector<Goal> ClassifierResults::goals() const {
  const auto mean = [&](int controller, auto network, int recipe, int test) {
    return measured(controller, [&](const ClassifierFindings& f) {
      const NetworkErrors& errors = f.by_recipe[recipe].*network;
      return test < 0 ? errors.training : errors.test[test];
    });
  };
  const auto others = [&](auto network, int recipe, int test) {
    return fmt::format("held {:.1e}, pd {:.1e}", mean(kHeld, network, recipe, test).mean(),
                       mean(kPd, network, recipe, test).mean());
  };
  std::vector<Goal> goals;
  const auto add = [&](const char* name, auto network, const char* what, int recipe, int test,
                       const char* paper, const char* study, double bound, std::string note) {
    goals.push_back(
        {.what = fmt::format("{} classifier, {} ({}, fast)", name, what, training_set(recipes_[recipe])),
         .paper = paper,
         .study = study,
         .bound = bound,
         .measured = mean(kFast, network, recipe, test),
         .note = others(network, recipe, test) + std::move(note)});
  };
  const auto few = [&](auto network) {
    return fmt::format("; from 900 noisy patterns {:.1e}; without the next torque {:.1e} (fast), {:.1e} (pd)",
                       mean(kFast, network, kBestNoisyRecipe, 1).mean(),
                       mean(kFast, network, kPaperManyRecipe, 1).mean(),
                       mean(kPd, network, kPaperManyRecipe, 1).mean());
  };
  const std::string floor = fmt::format(
      "; held is bounded by {:.1e}, the posterior of the true model, because its first torque is zero",
      measured(kHeld, [](const ClassifierFindings& f) { return f.posterior[0]; }).mean());
  constexpr auto mlp = &ClassifierErrors::mlp, rbfn = &ClassifierErrors::rbfn;
  add("MLP", mlp, "training", kBestCleanRecipe, -1, "2.1e-3", "2.4e-5", 2.1e-3, floor);
  add("MLP", mlp, "test 1", kBestCleanRecipe, 0, "1.9e-2", "3.4e-3", 3.4e-3, floor);
  add("MLP", mlp, "test 2, sigma .01", kBestManyRecipe, 1, "2.8e-2", "1.1e-2", 1.5e-2, few(mlp));
  add("MLP", mlp, "test 2, sigma .01, below the paper", kBestNoisyRecipe, 1, "2.8e-2", "3.0e-2", 2.8e-2, "");
  add("RBFN", rbfn, "training", kBestCleanRecipe, -1, "2.1e-2", "1.0e-2", 2.1e-2, "");
  add("RBFN", rbfn, "test 1", kBestCleanRecipe, 0, "3.9e-2", "2.1e-2", 2.0e-2, "");
  add("RBFN", rbfn, "test 2, sigma .01", kBestManyRecipe, 1, "1.5e-1", "3.8e-2", 3.5e-2, few(rbfn));
  add("RBFN", rbfn, "test 2, sigma .01, below the paper", kBestNoisyRecipe, 1, "1.5e-1", "-", 1.5e-1, "");
  return goals;
}

}  // namespace faultline
