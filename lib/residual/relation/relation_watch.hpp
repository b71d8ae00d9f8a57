// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "lib/residual/relation/relation_residual.hpp"
#include "lib/residual/relation/windowed_means.hpp"

namespace faultline {

/// A stretch of a log in which a signal does not follow what it follows in healthy logs.
struct RelationEpisode {
  RelationKind kind = RelationKind::actuator;
  int joint = 0;  ///< from 0
  Quantity target = Quantity::tau_meas;
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< begin of what strayed
  double alarm_s = std::numeric_limits<double>::quiet_NaN();  ///< first row with a mean beyond its limit
  double end_s = std::numeric_limits<double>::quiet_NaN();    ///< last row that strayed
  bool lasts = false;                                         ///< to the last row
  double mean = 0.0;             ///< of the residual from onset to end, in the target's unit
  double share = 0.0;            ///< of the predicted torque that is missing, by least squares
  double share_explains = 0.0;   ///< of the residual's square that this share explains
  double offset_explains = 0.0;  ///< of the residual's square that a constant explains
  double times_limit = 0.0;      ///< the largest mean over its limit
  double strongest = 0.0;        ///< that mean, in the target's unit
  double nats = 0.0;             ///< log likelihood ratio of an offset in that window against none
  /// Over the first .3 s at most: as above, and from the least to the largest value of target and prediction.
  double first_share = 0.0, first_share_explains = 0.0, first_span = 0.0, first_predicted_span = 0.0;
  /// The same of the first input: a reference that moves has a span, or as a velocity a root mean square.
  double first_reference_span = 0.0, first_reference_rms = 0.0;
  double first_rms = 0.0, first_predicted_rms = 0.0;  ///< root mean squares of target and prediction
};

/// Watches one relation along a log for means over windows beyond their limits.
class RelationWatch {
 public:
  /// `relation` outlives this.
  explicit RelationWatch(const SignalRelation& relation);

  void take(const Log& segment);
  /// After the last segment.
  void finish();
  const std::vector<RelationEpisode>& episodes() const { return episodes_; }
  double judged_s() const { return static_cast<double>(judged_rows_) * relation_.period_s; }
  /// For how long the inputs were beyond all that was learned, so that nothing was judged, s.
  double beyond_s() const { return residual_.beyond_s(); }

 private:
  /// The window whose mean is farthest beyond what is allowed, and how far.
  struct Strayed {
    int window = 0;
    double times = 0.0;
  };

  /// Of the rows of an episode.
  struct Sums {
    double residual = 0.0, square = 0.0, product = 0.0, predicted_square = 0.0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    double predicted_low = low, predicted_high = high;
    double reference_low = low, reference_high = high;
    double target_square = 0.0, reference_square = 0.0;
    long long rows = 0;

    void add(const RelationSample& sample);
    double share() const { return predicted_square > 0.0 ? -product / predicted_square : 0.0; }
    /// Of the residual's square.
    double share_explains() const {
      return predicted_square > 0.0 && square > 0.0 ? product * product / (predicted_square * square) : 0.0;
    }
  };

  void look_for_changes(const Log& segment);
  bool is_connected() const;
  void judge(const RelationSample& sample);
  Strayed farthest() const;
  double allowed(int window) const;
  double allowed_over(const Sums& sums) const;
  std::size_t onset_in(int window) const;
  void open(const RelationSample& sample, const Strayed& strayed);
  void go_on(const RelationSample& sample, const Strayed& strayed);
  void close(bool lasts);
  void describe_first(RelationEpisode& episode) const;
  double end_of(double last_s) const;
  bool says_something() const;
  double quiet_rms_before(std::size_t onset) const;
  bool is_quiet_again() const;

  const SignalRelation& relation_;
  RelationResidual residual_;
  WindowedMeans means_, predicted_, by_speed_;
  WindowedMeans quiet_, quiet_squares_;  ///< of the residual over the time that decides about an end
  std::deque<RelationSample> recent_;    ///< in step, of twice the longest window
  std::vector<RelationEpisode> episodes_;
  std::optional<RelationEpisode> now_;
  int window_ = 0;  ///< the shortest that showed the episode
  Sums since_onset_, strayed_, at_first_;
  int calm_rows_ = 0;  ///< judged, since the last that strayed
  /// Root mean square of the residual before the episode; NaN while none is known.
  double quiet_rms_ = std::numeric_limits<double>::quiet_NaN();
  double peak_ = 0.0;  ///< largest mean over that window, either sign
  long long judged_rows_ = 0;
  bool target_moves_ = false, input_moves_ = false;  ///< a channel that never changes is not connected
  double first_target_ = std::numeric_limits<double>::quiet_NaN(), first_input_ = first_target_;
};

}  // namespace faultline
