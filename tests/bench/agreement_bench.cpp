// SPDX-License-Identifier: MIT
// How much two networks that see the same residual differ: why cases find little to settle (docs/paper.md).
// Prints one line a noise and kind of run; held controller, best recipe, a seed that the reproduction does
// not use.
#include <fmt/format.h>

#include <cmath>

#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"
#include "lib/reproduce/runs/criterion_sweep.hpp"
#include "lib/reproduce/runs/detectors.hpp"
#include "lib/reproduce/runs/run_condition.hpp"

namespace {

using namespace faultline;

constexpr std::uint64_t kSeed = 101;
constexpr double kSampleCap = 10.0;  // nats, as in the study
constexpr ControllerVariant kController = ControllerVariant::held;

/// Sums for a correlation coefficient.
class Correlation {
 public:
  void add(double x, double y) { n_ += 1.0, x_ += x, y_ += y, xx_ += x * x, yy_ += y * y, xy_ += x * y; }
  double value() const {
    const double cov = xy_ / n_ - x_ / n_ * y_ / n_;
    return cov / std::sqrt((xx_ / n_ - x_ * x_ / n_ / n_) * (yy_ / n_ - y_ * y_ / n_ / n_));
  }

 private:
  double n_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, yy_ = 0.0, xy_ = 0.0;
};

struct Agreement {
  Correlation log_odds;
  long samples = 0, same = 0, mlp_wrong = 0, rbfn_wrong = 0, same_wrong = 0;
};

int largest(const Eigen::MatrixXd& outputs, Eigen::Index i) {
  int best = 0;
  outputs.col(i).maxCoeff(&best);
  return best;
}

/// Samples of faulty runs from the onset on, or all of fault-free ones.
void add(Agreement& agreement, const SampleDetector& detector, const ExperimentRun& run) {
  const SampleOutputs outputs = outputs_of(detector, run.log);
  const OutputMeaning meaning{detector.classifier.classes, detector.classifier.prior};
  const Eigen::MatrixXd mlp = sample_log_odds(meaning, outputs.mlp, kSampleCap);
  const Eigen::MatrixXd rbfn = sample_log_odds(meaning, outputs.rbfn, kSampleCap);
  const int fault_free = static_cast<int>(outputs.mlp.rows()) - 1;
  for (Eigen::Index i = 0; i < outputs.time.size(); ++i) {
    if (run.faulty() && outputs.time[i] <= run.onset_s) continue;
    if (!outputs.mlp.col(i).allFinite() || !outputs.rbfn.col(i).allFinite()) continue;
    for (Eigen::Index fault = 0; fault < mlp.rows(); ++fault)
      agreement.log_odds.add(mlp(fault, i), rbfn(fault, i));
    const int by_mlp = largest(outputs.mlp, i), by_rbfn = largest(outputs.rbfn, i);
    ++agreement.samples;
    agreement.same += by_mlp == by_rbfn;
    agreement.mlp_wrong += by_mlp != fault_free;
    agreement.rbfn_wrong += by_rbfn != fault_free;
    agreement.same_wrong += by_mlp != fault_free && by_mlp == by_rbfn;
  }
}

void measure(double sigma) {
  const Experiment experiment = experiment_on(bench_robot(), kController, kSeed);
  const RunPlan plan = run_plan(kController, false);
  GeneratorRecipe recipe;
  recipe.sigma = sigma;
  recipe.fit.kind = ResidualKind::physics;
  const ResidualGenerator generator = train_generator(experiment, recipe);
  const auto runs = [&](const RunSet& set, SeedUse use) {
    return with_noise(monitored_runs(experiment, set, use), experiment, sigma, use);
  };
  const SampleDetector detector = train_best_detector(generator, runs(plan.training, SeedUse::run_training),
                                                      plan.patterns_per_class, kSeed);
  Agreement faulty, fault_free;
  for (const ExperimentRun& run : runs({.faulty = 100, .fault_free_h = 3.0}, SeedUse::run_tuning))
    add(run.faulty() ? faulty : fault_free, detector, run);
  for (const Agreement* a : {&faulty, &fault_free}) {
    fmt::print("noise {}, {}: log odds correlated by {:.2f}, the same class in {:.2f} % of {} samples", sigma,
               a == &faulty ? "after the onset" : "fault-free", a->log_odds.value(),
               100.0 * static_cast<double>(a->same) / static_cast<double>(a->samples), a->samples);
    if (a == &fault_free)
      fmt::print("; wrong: MLP {}, RBFN {}, both in the same way {}", a->mlp_wrong, a->rbfn_wrong,
                 a->same_wrong);
    fmt::print("\n");
  }
}

}  // namespace

int main() {
  for (const double sigma : {0.01, 0.1}) measure(sigma);
}
