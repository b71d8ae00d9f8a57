// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/measured_residual.hpp"
#include "lib/balance/regress.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/core/joint.hpp"
#include "lib/explain/effect_columns.hpp"
#include "lib/explain/fault_columns.hpp"

namespace faultline {

/// Explanation of a log by the robot, the effects of the day and the columns of a hypothesis.
struct Explanation {
  double log_likelihood = 0.0;      ///< marginal: effects, sizes and changes of the work piece integrated out
  Eigen::VectorXd day;              ///< effects: those of the day, then sizes of known faults
  Eigen::VectorXd day_std;          ///< standard deviation of each; only without a hypothesis
  Eigen::VectorXd size;             ///< of the hypothesis' columns
  Eigen::MatrixXd size_covariance;  ///< of the sizes, given rows and prior
  Stacked left;                     ///< whitened residuals; NaN for rows without weight
  PiecePath path;                   ///< of the work piece; empty without one
  Eigen::VectorXd piece_level;      ///< the path, smoothed
  Eigen::VectorXd later_s;          ///< by change of the path: delay after the middle of its two rows
  double mean_square() const;       ///< of the residuals: 1 if they are noise
};

/// A whitened column that is 0 except in a few rows: the effect of a change of the work piece that comes at
/// another time than its path has it.
struct WhitePulse {
  int begin = 0;           ///< first row
  Eigen::MatrixXd torque;  ///< rows from there on x joints
  double variance = 1.0;   ///< of its size
};

inline constexpr int kPathRounds = 4;  ///< rounds that estimate path of the work piece and effects in turn

/// One log and one model: the common part of all hypotheses.
class LogFit {
 public:
  /// `known` are faults that the log is known to contain: their sizes are estimated beside the effects of the
  /// day (near the size of the claim if the fault began before the log, since a lost torque and the gain of
  /// the day cannot be distinguished without healthy rows), false readings are corrected, silent rows have no
  /// weight. `noise`: that of the rows; without it, that of the model, or that of the log if it is larger
  /// (own_noise()). Throws Error(input) when the log is shorter than the kernels. The model must outlive it.
  LogFit(UniformLog log, const BalanceModel& model, std::vector<FaultClaim> known = {},
         const std::optional<RowNoise>& noise = std::nullopt);

  /// Log without the known false readings.
  const UniformLog& log() const { return log_; }
  const std::vector<FaultClaim>& known() const { return known_; }
  /// Torque that the columns of the known faults may lack (form_shares()), for each that adds torque.
  const std::vector<Stacked>& form_errors() const { return form_errors_; }
  /// Returns whether the rows of a joint are silent at a time because of a known fault.
  bool is_silent(Joint joint, double time_s) const;
  const BalanceModel& model() const { return model_; }
  const RowNoise& noise() const { return noise_; }
  const BalanceRows& rows() const { return rows_; }
  int count() const { return rows_.rows(); }
  int joints() const { return model_.joints(); }
  Joint last_joint() const { return Joint::at(joints() - 1); }
  const Eigen::VectorXd& time_s() const { return rows_.time_s; }
  /// Returns the first row at or after a time; count() if there is none.
  int first_row(double time_s) const;
  /// Returns the first row at or after `row` whose whitened values contain no row before `row`.
  int whitened_reach(int row) const;
  const Eigen::VectorXd& loudness() const { return noise_level_; }
  /// Standard deviation of each row, rows x joints.
  const Eigen::MatrixXd& std() const { return std_; }
  /// Residual torque of robot and known faults, before the effects.
  const Stacked& residual() const { return residual_; }
  /// Returns the residual of a log with other measurements of joint `j` (from 0) from `from_s` on.
  Stacked residual_of(const MeasuredMotion& moved, int j, double from_s) const;
  const std::vector<LinearFault>& linear() const { return linear_; }
  /// Columns of the effects of every hypothesis: those of the day (DayLayout), then the sizes of the known
  /// faults.
  const EffectColumns& effects() const { return effects_; }
  /// The same, whitened.
  const EffectColumns& white_effects() const { return white_effects_; }
  const Eigen::VectorXd& effect_variance() const { return effect_variance_; }
  const Explanation& healthy() const { return healthy_; }
  /// Path of the work piece before effects of the day were estimated.
  const PiecePath& first_path() const { return first_path_; }
  bool has_piece() const { return model_.piece_kg > 0.0; }

  Stacked whitened(const Stacked& torque) const;
  StackedColumns whitened(const StackedColumns& columns) const;

  /// Explains the log with these columns and the path of the work piece `path` (empty without one).
  Explanation explain(const Stacked& residual, const FaultColumns& columns, const PiecePath& path,
                      const StackedMask& dropped = {}) const {
    return explain(prepared(residual, columns, dropped), path);
  }
  /// Explains the log likewise with the best path of the work piece for the hypothesis, searched from that of
  /// the healthy log and from one for each of the sizes `starts`. `onset_s` is that of the hypothesis: the
  /// paths for `starts` take the effects of the day from the rows before it.
  Explanation explain_with_piece(const Stacked& residual, const FaultColumns& columns,
                                 const std::vector<Eigen::VectorXd>& starts, double onset_s,
                                 const StackedMask& dropped = {}) const;
  /// Returns the torque of the effects.
  Stacked day_torque(const Eigen::VectorXd& day) const;
  Stacked piece_torque(const Eigen::VectorXd& level) const;
  /// Returns the whitened residuals of an explanation without its fault, but with its effects of the day and
  /// its work piece.
  Stacked residual_without_fault(const Explanation& explanation) const;
  /// Returns the effects of the day, estimated from the rows before `time_s`.
  Eigen::VectorXd day_before(double time_s) const;
  /// Returns the columns of a fault while it lasts.
  FaultColumns between(const FaultColumns& columns, double onset_s, double end_s) const;

 private:
  /// Common part of all paths of the work piece.
  struct Prepared {
    Stacked white;             ///< whitened residual; 0 for dropped rows
    StackedColumns column{};   ///< of the hypothesis, whitened
    Eigen::VectorXd variance;  ///< of their sizes
    StackedMask dropped;       ///< empty if no row is
    int lost = 0;              ///< number of dropped rows
    Eigen::MatrixXd square{};  ///< X' X of the effects, then of the columns
    Eigen::MatrixXd factor{};  ///< posterior_factor() of them
  };

  Prepared prepared(const Stacked& residual, const FaultColumns& columns, const StackedMask& dropped) const;
  Explanation explain(const Prepared& hypothesis, const PiecePath& path) const;
  void loosen_halts();
  void add_fault(const FaultColumns& columns, const FaultClaim& claim);
  void settle_healthy();
  void whiten_effects();
  Explanation regressed(const Prepared& hypothesis, const PieceRamps& ramps) const;
  /// Returns the whitened columns of the changes of a path, and of changes before the first and after the
  /// last row.
  std::vector<WhitePulse> white_pulses(const PieceRamps& ramps, const StackedMask& dropped) const;
  /// Returns the times of the changes of a path as the healthy explanation has them; 0 for those it lacks.
  Eigen::VectorXd known_times_of(const PiecePath& path) const;
  PiecePath path_of(const Stacked& left, const StackedMask& dropped, bool wide) const;

  std::vector<FaultClaim> known_;
  UniformLog log_;
  const BalanceModel& model_;
  BalanceRows rows_;
  MeasuredResidual reading_;
  Eigen::VectorXd noise_level_;
  RowNoise noise_;
  Eigen::MatrixXd std_, tip_;
  std::vector<Whitener> white_;  ///< by joint, for std_ and noise_
  Stacked residual_, spring_;
  Stacked known_torque_;  ///< of the known faults, with the sizes of their claims
  std::vector<Stacked> form_errors_;
  std::vector<LinearFault> linear_;
  StackedMask silent_;  ///< empty if no row is
  EffectColumns effects_, white_effects_;
  std::vector<Eigen::VectorXd> end_levels_;  ///< of a work piece that changes beside the first or last row
  Eigen::MatrixXd effect_square_;            ///< X' X of the whitened effects
  Eigen::VectorXd effect_variance_;
  Eigen::MatrixXd effect_factor_;  ///< posterior_factor() of the effects
  PiecePath first_path_;
  Explanation healthy_;
  mutable std::vector<std::pair<int, Eigen::VectorXd>> before_;
};

/// For each joint: the number of rows between onset and end of a claim that have weight in an explanation,
/// and the mean square of their whitened residuals; 1 without such rows.
struct ResidualWithin {
  Eigen::VectorXd rows, square;
};
ResidualWithin residual_within(const LogFit& fit, const FaultClaim& claim, const Explanation& e);

/// Returns the residual of the log after the correction of a false reading of that size.
Stacked residual_without(const LogFit& fit, FaultClaim claim, double size);
/// Returns the columns of a linear fault or of a collision while it lasts.
FaultColumns columns_of(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
