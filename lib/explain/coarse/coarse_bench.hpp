// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lib/explain/coarse/coarse_judge.hpp"
#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// A hypothesis at a coarse rate that was judged.
struct JudgedGuess {
  CoarseGuess guess;
  FaultKind kind = FaultKind::none;  ///< as it is called: a lost torque may be a free joint
  double gain = -1e300;
  CoarseExplanation fit;
};

/// Judges hypotheses of one log at a coarse rate; keeps the best of each kind and joint, and the onsets of
/// all.
class CoarseBench {
 public:
  explicit CoarseBench(const CoarseLog& of) : log(of) {}

  const CoarseLog& log;
  std::vector<JudgedGuess> best{};
  std::vector<CoarseGuess> tried{};

  /// Judges a guess with so many rounds of integration and regression, the first with the steps that are
  /// known of another guess.
  JudgedGuess go(const CoarseGuess& guess, int rounds = kCoarseRounds,
                 const std::shared_ptr<const CoarseSteps>& known = {});
  /// One round from where its best onset is, if that matters; `known` are steps of the guess.
  void go_near(const CoarseGuess& guess, const std::shared_ptr<const CoarseSteps>& known);
  /// Integrates those that may win about the trajectories that they imply; all where the best leaves much.
  void integrate_best();
  bool tried_near(FaultKind kind, int joint, double onset_s) const;
  double best_gain() const;
  /// The best of each kind and joint, best first.
  std::vector<FaultHypothesis> ranked() const;

  static constexpr int kCoarseRounds = 3;  ///< of integration and regression in turn, at most

 private:
  JudgedGuess judge_and_keep(const CoarseGuess& guess, int rounds,
                             const std::shared_ptr<const CoarseSteps>& known);
};

inline constexpr double kLongSample_s = 0.05;  ///< a step of Newton is at most a share of a longer sample
inline constexpr double kMuchLeft = 3.0;  ///< mean square left: an explanation that leaves more may be wrong
inline constexpr double kSettled_s = 2e-4;  ///< an onset that moves less is settled

/// Whether a fault of the kind changes numbers that move the robot, and stays.
inline bool is_linear_at_coarse(FaultKind kind) {
  return kind == FaultKind::torque_loss || kind == FaultKind::friction_increase ||
         kind == FaultKind::payload_change || kind == FaultKind::torque_sensor_error;
}

/// Whether the onset of a kind lies between samples.
bool moves_with_onset(FaultKind kind);

/// The guess with its onset moved and, where it has an end, that moved by `end_step_s` of its own.
CoarseGuess with_times_moved(CoarseGuess guess, double onset_step_s, double end_step_s);

/// A step of Newton on onset and size together: where the guess should be, and by how much its onset wanted
/// to move. Nothing where it cannot be integrated.
struct NewtonStep {
  CoarseGuess guess;
  double onset_step_s = 0.0;
  std::shared_ptr<const CoarseSteps> steps;  ///< that it was taken with
};
std::optional<NewtonStep> newton_step(const CoarseLog& log, CoarseGuess guess, const CoarseJudging& how);

}  // namespace faultline
