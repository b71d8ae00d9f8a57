// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

// What a hypothesis costs, or must reach, beside its columns: the same at fine and at coarse rates. Prices
// are natural logarithms of prior probabilities (nats).

inline constexpr double kNoSuchSize = 1e9;  ///< of a size that no fault of the kind has
inline constexpr double kMostLoss = 1.2;    ///< of the torque: more is lost only by an error of the fit
inline constexpr double kBeyondLoss = 2e4;  ///< for each share of the torque that is lost beyond kMostLoss
inline constexpr double kStillJoint = 3.0;  ///< of a joint that does not move, or whose position does not
inline constexpr double kForcedRow = 1.2;   ///< for each row that an unknown force explains
inline constexpr double kRepeatedReading = 2.0;  ///< for each repeated reading of a joint called locked
inline constexpr int kMostRepeats = 500;         ///< readings whose repetition counts for a stuck encoder
inline constexpr double kStuckShare = 0.98;      ///< of the readings that a stuck encoder repeats, at least
inline constexpr double kFreeShare = 0.9;        ///< of the torque lost, from which a joint swings freely
inline constexpr double kFormShare =
    0.05;  ///< of its effect that a known fault may miss; an unknown one, none

inline constexpr double kStandsOut = 8.0;      ///< nats from which an onset stands out
inline constexpr double kWorthRefining = 5.0;  ///< nats from which an onset is refined
inline constexpr double kMayWin = 0.3;         ///< of the best evidence: what has less is not refined

}  // namespace faultline
