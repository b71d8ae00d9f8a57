// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/explain/coarse/coarse_judge.hpp"
#include "lib/explain/explain.hpp"

namespace faultline {

/// A hypothesis at a coarse rate that was judged.
struct JudgedGuess {
  CoarseGuess guess;
  FaultKind kind = FaultKind::none;  ///< kind to report: a torque loss may be a free joint
  double gain = 0.0;                 ///< nats by which it explains the log better than the healthy robot
  CoarseExplanation fit;
};

/// Judges hypotheses of one log at a coarse rate; keeps the best of each kind and joint, and all guesses.
class CoarseBench {
 public:
  explicit CoarseBench(const CoarseLog& of) : log(of) {}

  const CoarseLog& log;
  std::vector<JudgedGuess> best{};
  std::vector<CoarseGuess> tried{};

  /// Judges a guess with up to `rounds` rounds of integration and regression, the first with steps `known` of
  /// another guess; a drift also with a velocity that is measured independently. Empty if the guess cannot be
  /// integrated.
  std::optional<JudgedGuess> go(const CoarseGuess& guess, int rounds = kCoarseRounds,
                                const std::shared_ptr<const CoarseSteps>& known = {});
  /// Judges the guess at its best onset, if that may lie between samples, in one round; `known`: its steps.
  void go_near(const CoarseGuess& guess, const std::shared_ptr<const CoarseSteps>& known);
  /// Integrates the best guesses that may win anew about the trajectories that they imply; all of them if the
  /// best one has large residuals.
  void integrate_best();
  bool tried_near(FaultKind kind, Joint joint, double onset_s) const;
  double best_gain() const;
  /// Returns the explanation of the log by these hypotheses.
  LogExplanation explanation() const;

  static constexpr int kCoarseRounds = 3;  ///< of integration and regression in turn, at most

 private:
  std::optional<JudgedGuess> judge_and_keep(const CoarseGuess& guess, int rounds,
                                            const std::shared_ptr<const CoarseSteps>& known);
};

inline constexpr double kLongSample_s = 0.05;  ///< longer samples bound a Newton step by a share of them
inline constexpr double kLargeResidual = 3.0;  ///< mean square of residuals above which a fit may be wrong
inline constexpr double kSettled_s = 2e-4;     ///< an onset that moves less is settled
/// Share of each state that is tolerated as an error of a wrong onset at first: a sample's worth.
inline constexpr double kFirstTolerated = 5e-3;

/// Returns whether the onset of a kind may lie between samples.
bool moves_with_onset(FaultKind kind);

/// Returns the guess with its onset moved by `onset_step_s` and its end, if it has one, by `end_step_s`.
CoarseGuess with_times_moved(CoarseGuess guess, double onset_step_s, double end_step_s);

/// A Newton step of onset and size together, with the step of the onset before it was limited; newton_step()
/// returns none if the guess cannot be integrated.
struct NewtonStep {
  CoarseGuess guess;
  double onset_step_s = 0.0;
  std::shared_ptr<const CoarseSteps> steps;  ///< steps of the log with which it was computed
};
std::optional<NewtonStep> newton_step(const CoarseLog& log, CoarseGuess guess, const CoarseJudging& how);

}  // namespace faultline
