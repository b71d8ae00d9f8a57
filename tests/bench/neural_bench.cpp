// SPDX-License-Identifier: MIT
// What the networks and residuals cost and reach: prints one line a measurement. See docs/neural.md.
#include <fmt/format.h>

#include <ctime>

#include "lib/log/log_source.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/rbfn.hpp"
#include "lib/residual/learn_residual.hpp"
#include "lib/residual/residuals.hpp"
#include "tests/support/bench_motion.hpp"

namespace {

using namespace faultline;

/// CPU time, so that other work on the machine does not count.
double now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double seconds_since(double start_s) { return now_s() - start_s; }

void time_forward() {
  const Mlp mlp = make_mlp({9, 49, 6});
  const Eigen::MatrixXd inputs = Eigen::MatrixXd::Random(9, 4096);
  const double start = now_s();
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) sum += forward(mlp, inputs)(0, 0);
  fmt::print("forward 9-49-6: {:.0f} ns a row (sum {:.1f})\n", seconds_since(start) / 409600 * 1e9, sum);
}

void learn(const char* name, const BenchMotion& motion, const ResidualOptions& options) {
  const Robot robot = bench_robot();
  MemorySource source(bench_log(robot, motion));
  LogSource* logs[] = {&source};
  const double start = now_s();
  const LearnedResidual learned = learn_residual_generator(logs, robot, 0.0, options);
  fmt::print("{}: normalised mse {:.2e} (nothing changes: {:.2e}), {} patterns, {:.1f} s\n", name,
             learned.normalised_mse, learned.persistence_mse, learned.training_patterns,
             seconds_since(start));
  ResidualState state;
  source.rewind();
  Log segment;
  const double begin = now_s();
  double sum = 0.0;
  while (source.next(segment)) sum += compute_residuals(learned.generator, segment, state).velocity.sum();
  fmt::print("    residuals {:.0f} ns a row (sum {:.1f})\n", seconds_since(begin) / source.log().rows() * 1e9,
             sum);
}

void time_judge() {
  const Eigen::MatrixXd inputs = Eigen::MatrixXd::Random(40, 1500);
  Patterns patterns{inputs, Eigen::MatrixXd::Zero(18, 1500)};
  for (int n = 0; n < 1500; ++n) {
    int label = 0;
    (inputs.col(n).head(18) + 0.5 * inputs.col(n).segment(20, 18)).maxCoeff(&label);
    patterns.targets(label, n) = 1.0;
  }
  const PatternSplit split = split_patterns(patterns, 0.2);
  double start = now_s();
  const Mlp mlp = train_quasi_newton(make_mlp({40, 24, 18}, OutputKind::softmax), split.training,
                                     split.validation, {.weight_decay = 1e-4});
  fmt::print("judge 40-24-18, 1500 patterns, quasi-Newton: {:.2f} s; validation mse {:.3f}\n",
             seconds_since(start), mean_squared_error(mlp, split.validation));
  start = now_s();
  const Rbfn rbfn = train_rbfn(split.training, {.rows = 12, .columns = 12});
  fmt::print("judge RBFN 144 units: {:.2f} s; training mse {:.3f}, validation mse {:.3f}\n",
             seconds_since(start), mean_squared_error(rbfn, split.training),
             mean_squared_error(rbfn, split.validation));
}

/// The paper's protocol: 9-49-6 on 2500 logged patterns, nothing from the twin.
ResidualOptions papers(ResidualTrainer trainer) {
  return {.target = PredictedQuantity::state, .trainer = trainer, .max_patterns = 2500, .twin_share = 0.0};
}

}  // namespace

int main() {
  time_forward();
  time_judge();
  const BenchMotion held{.duration_s = 360.0}, noisy{.duration_s = 360.0, .noise = 0.01};
  learn("paper, held, LM", held, papers(ResidualTrainer::levenberg_marquardt));
  learn("paper, held, back-propagation", held, papers(ResidualTrainer::back_propagation));
  learn("paper, held sigma .01, LM", noisy, papers(ResidualTrainer::levenberg_marquardt));
  learn("default, held", held, {});
  learn("default, held sigma .01", noisy, {});
  learn("physics, held", held, {.kind = ResidualKind::physics});
  const BenchMotion fast{.duration_s = 60.0, .log_period_s = 0.001, .noise = 1e-4};
  learn("default, 1 kHz", fast, {});
  learn("hybrid, 1 kHz", fast, {.kind = ResidualKind::hybrid, .hidden = {20}});
  learn("physics, 1 kHz", fast, {.kind = ResidualKind::physics});
}
