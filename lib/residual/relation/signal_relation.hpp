// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/log.hpp"

/// Second residuals: relations between signals of a log that do not depend on the mechanics of the robot. The
/// measured torque follows the commanded one, the commanded torque follows the inputs of the controller, and
/// the motion follows its reference.

namespace faultline {

enum class RelationKind {
  actuator,     ///< measured torque by commanded torque
  control_law,  ///< commanded torque by reference and motion
  tracking,     ///< position or velocity by its reference
};
/// "actuator", "control_law", "tracking".
const char* to_string(RelationKind kind);

/// The deviation of the mean of a residual over a window in healthy operation.
struct WindowLimit {
  double window_s = 0.0;
  double std = 0.0;    ///< of the mean in healthy logs, each held out of the fit that it is measured with
  double limit = 0.0;  ///< a mean beyond it is an alarm; in the target's unit
};

/// A signal of one joint as a linear function of others in the same row and some rows before, learned from
/// healthy logs.
struct SignalRelation {
  RelationKind kind = RelationKind::actuator;
  Joint joint{};
  Quantity target = Quantity::tau_meas;
  std::vector<Quantity> inputs{};  ///< of the same joint
  int lags = 0;                    ///< earlier rows that are used beside the row itself
  int stride = 1;                  ///< rows from one of them to the next
  /// Change per second that the target cannot exceed, as of a drive that limits its acceleration: the first
  /// input is followed no faster. 0: no such limit.
  double rate_limit = 0.0;
  double period_s = 0.0;  ///< from row to row; after a longer step the lags begin anew
  /// By input: of its value, then of its changes from row to row, the latest first. The last one is a
  /// constant.
  std::vector<double> weights{};
  double low = 0.0, high = 0.0;  ///< of the target in the healthy logs, in its unit
  /// Learned range of each term that a weight multiplies, without the constant.
  std::vector<double> term_low{}, term_high{};
  double r2 = 0.0;                     ///< share of the target's variance that is explained in held-out logs
  std::vector<WindowLimit> windows{};  ///< the shortest first
  double offset_range = 0.0;           ///< N m or N by which healthy days may differ by a constant
  double gain_range = 0.0;             ///< share of the target by which they may differ

  int weights_needed() const { return static_cast<int>(inputs.size()) * (lags + 1) + 1; }
};

/// Largest allowed mean over window number `window`, in the target's unit: the limit and the differences
/// between days, as independent errors. `torque` and `by_speed` are mean magnitudes over the window, of the
/// predicted torque and of RelationSample::by_speed.
double allowed_mean(const SignalRelation& relation, int window, double torque = 0.0, double by_speed = 0.0);

/// Returns the quantity of the log that holds the commanded or the measured torque; nullopt if it has none.
/// `torque_is_commanded`: `tau` is the commanded torque, else the measured one.
std::optional<Quantity> commanded_torque(const Log& log, bool torque_is_commanded);
std::optional<Quantity> measured_torque(const Log& log, bool torque_is_commanded);

/// Whether the log has torques of any meaning.
bool has_torque(const Log& log);

bool has_signals(const Log& log, const SignalRelation& relation);

nlohmann::json relations_to_json(const std::vector<SignalRelation>& relations);
/// Reads relations. Throws Error(input), which names `where`, for those that do not fit together or are not
/// of a robot with `joints` joints, and what nlohmann::json throws.
std::vector<SignalRelation> relations_from_json(const nlohmann::json& list, int joints,
                                                const std::string& where);

}  // namespace faultline
