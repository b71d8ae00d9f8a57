// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/residual/relation/relation_residual.hpp"

namespace faultline {

/// Sums over rows of an episode.
struct RelationSums {
  double residual = 0.0, square = 0.0, product = 0.0, predicted_square = 0.0;
  double low = std::numeric_limits<double>::infinity(), high = -low;  ///< of the target
  double predicted_low = low, predicted_high = high;
  double reference_low = low, reference_high = high;
  double target_square = 0.0, reference_square = 0.0;
  long long rows = 0;

  void add(const RelationSample& sample);
  /// Share of the prediction that is missing, by least squares.
  double share() const { return predicted_square > 0.0 ? -product / predicted_square : 0.0; }
  /// Share of the residual's square that share() explains.
  double share_explains() const {
    return predicted_square > 0.0 && square > 0.0 ? product * product / (predicted_square * square) : 0.0;
  }
  /// Root mean square of what one of the sums of squares belongs to.
  double rms(double of_square) const {
    return std::sqrt(of_square / static_cast<double>(std::max(rows, 1LL)));
  }
};

/// A stretch of a log in which a signal deviates from its relation to others in the healthy logs.
struct RelationEpisode {
  RelationKind kind = RelationKind::actuator;
  Joint joint{};
  Quantity target = Quantity::tau_meas;
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< begin of the deviation
  double alarm_s = std::numeric_limits<double>::quiet_NaN();  ///< first row with a mean beyond its limit
  double end_s = std::numeric_limits<double>::quiet_NaN();    ///< end of the deviation
  bool lasts = false;                                         ///< to the last row
  double mean = 0.0;             ///< of the residual from onset to end, in the target's unit
  double share = 0.0;            ///< of the predicted torque that is missing, by least squares
  double share_explains = 0.0;   ///< of the residual's square that this share explains
  double offset_explains = 0.0;  ///< of the residual's square that a constant explains
  double times_limit = 0.0;      ///< largest ratio of a mean to its limit
  double strongest = 0.0;        ///< that mean, in the target's unit
  double nats = 0.0;             ///< log likelihood ratio of an offset in that window against none
  RelationSums at_first{};       ///< over the first .3 s at most
};

/// Finds episodes of one relation along a log: means of its residual over windows that exceed their limits.
class RelationDetector {
 public:
  /// `relation` outlives this.
  explicit RelationDetector(const SignalRelation& relation);

  void take(const Log& segment);
  /// Ends the log, after the last segment.
  void finish();
  const std::vector<RelationEpisode>& episodes() const { return episodes_; }
  double judged_s() const { return static_cast<double>(judged_rows_) * relation_.period_s; }
  /// For how long the inputs were outside the learned range, so that nothing was judged, s.
  double beyond_s() const { return residual_.beyond_s(); }

 private:
  /// The window with the largest ratio of its mean to the allowed one, and that ratio.
  struct LargestMean {
    int window = 0;
    double times = 0.0;
  };

  void look_for_changes(const Log& segment);
  bool is_connected() const;
  void judge(const RelationSample& sample);
  LargestMean farthest() const;
  double allowed(int window) const;
  double allowed_over(const RelationSums& sums) const;
  std::size_t onset_in(int window) const;
  void open(const RelationSample& sample, const LargestMean& largest_mean);
  void go_on(const RelationSample& sample, const LargestMean& largest_mean);
  void close(bool lasts);
  double end_of(double last_s) const;
  bool says_something() const;
  double quiet_rms_before(std::size_t onset) const;
  bool is_quiet_again() const;

  const SignalRelation& relation_;
  RelationResidual residual_;
  WindowedMeans means_, predicted_, by_speed_;
  WindowedMeans quiet_, quiet_squares_;  ///< of the residual over kQuiet_s, which decides about an end
  std::deque<RelationSample> recent_;    ///< latest rows, up to twice the longest window
  std::vector<RelationEpisode> episodes_;
  std::optional<RelationEpisode> now_;
  int window_ = 0;  ///< the shortest that exceeded its limit in the episode
  RelationSums since_onset_, deviating_;
  int normal_rows_ = 0;  ///< judged rows since the last that deviated
  /// Root mean square of the residual before the episode; NaN if it is not known.
  double quiet_rms_ = std::numeric_limits<double>::quiet_NaN();
  double peak_ = 0.0;  ///< largest magnitude of the mean over window_
  long long judged_rows_ = 0;
  bool target_moves_ = false, input_moves_ = false;  ///< a channel that never changes is not connected
  double first_target_ = std::numeric_limits<double>::quiet_NaN(), first_input_ = first_target_;
};

}  // namespace faultline
