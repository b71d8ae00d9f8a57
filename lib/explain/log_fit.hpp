// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/reading_residual.hpp"
#include "lib/balance/regress.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"
#include "lib/explain/fault_columns.hpp"

namespace faultline {

/// How well a log is explained by the robot, the day's effects and the columns of a hypothesis.
struct Explanation {
  double log_likelihood = 0.0;      ///< marginal: effects, sizes and changes of the work piece integrated out
  Eigen::VectorXd day;              ///< effects: those of the day, then sizes of known faults
  Eigen::VectorXd day_std;          ///< standard deviation of each; only without a hypothesis
  Eigen::VectorXd size;             ///< of the hypothesis' columns
  Eigen::MatrixXd size_covariance;  ///< of the sizes, by rows and prior
  Stacked left;                     ///< whitened rows left over; NaN where rows do not count
  PiecePath path;                   ///< of the work piece; empty without one
  Eigen::VectorXd piece_level;      ///< the path, smoothed
  Eigen::VectorXd later_s;          ///< by change of the path: than the middle between its two rows
  Eigen::VectorXd row_gain;         ///< by sample, at coarse rates: nats by which it beats the healthy robot
  double mean_square() const;       ///< of what is left: 1 where it is noise
};

/// A white column that is 0 but for a few rows: what the time of a change of the work piece is off by.
struct WhitePulse {
  int begin = 0;           ///< row
  Eigen::MatrixXd torque;  ///< rows from there on x joints
  double variance = 1.0;   ///< of its size
};

inline constexpr int kPathRounds = 4;  ///< of the work piece's path and the effects in turn

/// One log against one model: what all hypotheses share.
class LogFit {
 public:
  /// `known` are faults that the log is known to hold: their sizes are estimated beside the effects of the
  /// day (near the size of the claim where the fault began before the log: without healthy rows to compare
  /// with, a lost torque and the gain of the day look alike), false readings are mended, rows that say
  /// nothing do not count. `noise`: that of the rows where it is known; else that of the model, or the log's
  /// own where it is louder (own_noise()). Throws Error(input) when the log is shorter than the kernels. The
  /// model must outlive it.
  LogFit(UniformLog log, const BalanceModel& model, std::vector<FaultClaim> known = {},
         const std::optional<RowNoise>& noise = std::nullopt);

  /// Without the false readings that are known.
  const UniformLog& log() const { return log_; }
  const std::vector<FaultClaim>& known() const { return known_; }
  /// Whether a known fault leaves nothing to be said of joint `joint` (from 1) at a time.
  bool is_silent(int joint, double time_s) const;
  const BalanceModel& model() const { return model_; }
  const RowNoise& noise() const { return noise_; }
  const BalanceRows& rows() const { return rows_; }
  int count() const { return rows_.rows(); }
  int joints() const { return model_.joints(); }
  const Eigen::VectorXd& time_s() const { return rows_.time_s; }
  /// First row at or behind a time; count() where there is none.
  int first_row(double time_s) const;
  const Eigen::VectorXd& loudness() const { return loudness_; }
  /// Standard deviation of each row, rows x joints.
  const Eigen::MatrixXd& std() const { return std_; }
  /// Torque that robot and known faults leave unexplained, without effects.
  const Stacked& residual() const { return residual_; }
  /// The same of a log that has other readings of joint `joint` (from 0) from `from_s` on.
  Stacked residual_of(const JointReading& moved, int joint, double from_s) const;
  const std::vector<LinearFault>& linear() const { return linear_; }
  /// Effects that every hypothesis has: those of the day (DayLayout), then the sizes of the known faults. By
  /// joint: rows x effects.
  const std::vector<Eigen::MatrixXd>& effect_columns() const { return effect_column_; }
  /// The same, whitened and stacked.
  const StackedColumns& white_effects() const { return effect_white_; }
  const Eigen::VectorXd& effect_variance() const { return effect_variance_; }
  const Explanation& healthy() const { return healthy_; }
  /// Path of the work piece before anything was known of the day.
  const PiecePath& first_path() const { return first_path_; }
  bool has_piece() const { return model_.piece_kg > 0.0; }

  Stacked whitened(const Stacked& torque) const;
  StackedColumns whitened(const StackedColumns& columns) const;

  /// The log explained with these columns; `path` holds where a work piece is known to come and go.
  Explanation explain(const Stacked& residual, const FaultColumns& columns, const PiecePath& path,
                      const StackedMask& dropped = {}) const {
    return explain(prepared(residual, columns, dropped), path);
  }
  /// The same with the path of the work piece that fits the hypothesis best, from several starts: `starts`
  /// are sizes to begin with, empty for the path of the healthy log. `onset_s` is that of the hypothesis:
  /// effects of the day are first taken from the rows before it.
  Explanation explain_with_piece(const Stacked& residual, const FaultColumns& columns,
                                 const std::vector<Eigen::VectorXd>& starts, double onset_s,
                                 const StackedMask& dropped = {}) const;
  /// Torque of the effects.
  Stacked day_torque(const Eigen::VectorXd& day) const;
  Stacked piece_torque(const Eigen::VectorXd& level) const;
  /// Whitened rows that remain when the fault of an explanation is taken away and its effects of the day and
  /// its work piece stay.
  Stacked left_without_fault(const Explanation& explanation) const;
  /// Effects of the day as the rows before `time_s` show them.
  Eigen::VectorXd day_before(double time_s) const;
  /// Columns of a fault while it lasts.
  FaultColumns between(const FaultColumns& columns, double onset_s, double end_s) const;

 private:
  /// What all paths of the work piece share.
  struct Prepared {
    Stacked white;             ///< the residual's rows; 0 where they are dropped
    StackedColumns column;     ///< of the hypothesis, white
    Eigen::VectorXd variance;  ///< of their sizes
    StackedMask dropped;       ///< empty where no row is
    int lost = 0;              ///< rows that are dropped
    Eigen::MatrixXd square;    ///< X' X of the effects, then of the columns
  };

  Prepared prepared(const Stacked& residual, const FaultColumns& columns, const StackedMask& dropped) const;
  Explanation explain(const Prepared& hypothesis, const PiecePath& path) const;
  void loosen_halts();
  void add_fault(const FaultColumns& columns, const FaultClaim& claim);
  void settle_healthy();
  void whiten_effects();
  Explanation regressed(const Prepared& hypothesis, const PieceRamps& ramps) const;
  /// What changes of a path between and beside the rows would add.
  std::vector<WhitePulse> white_pulses(const PieceRamps& ramps, const StackedMask& dropped) const;
  /// When the changes of a path come, as far as the healthy explanation has the same ones.
  Eigen::VectorXd known_times_of(const PiecePath& path) const;
  PiecePath path_of(const Stacked& left, const StackedMask& dropped, bool wide) const;

  std::vector<FaultClaim> known_;
  UniformLog log_;
  const BalanceModel& model_;
  BalanceRows rows_;
  ReadingResidual reading_;
  Eigen::VectorXd loudness_;
  RowNoise noise_;
  Eigen::MatrixXd std_, tip_;
  Stacked residual_, spring_;
  Stacked known_torque_;  ///< of the faults that are known, as large as their claims say
  std::vector<LinearFault> linear_;
  StackedMask silent_;  ///< empty where no row is
  std::vector<Eigen::MatrixXd> effect_column_;
  StackedColumns effect_white_;
  std::vector<Eigen::VectorXd> end_levels_;  ///< of a work piece that changes beside the first or last row
  Eigen::MatrixXd effect_square_;
  Eigen::VectorXd effect_variance_;
  PiecePath first_path_;
  Explanation healthy_;
  mutable std::vector<std::pair<int, Eigen::VectorXd>> before_;
};

/// By joint: rows of an explanation that count from onset to end of a claim, and the mean of the squares of
/// what it leaves of them, whitened; 1 where no row counts.
struct LeftWithin {
  Eigen::VectorXd rows, square;
};
LeftWithin left_within(const LogFit& fit, const FaultClaim& claim, const Explanation& e);

/// Residual of the log without a false reading of that size.
Stacked residual_without(const LogFit& fit, FaultClaim claim, double size);
/// Columns of a linear fault or of a push while it lasts.
FaultColumns columns_of(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
