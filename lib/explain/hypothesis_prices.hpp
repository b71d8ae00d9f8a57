// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

// Prices and limits of hypotheses beside their columns: the same at fine and at coarse rates. Prices are
// natural logarithms of prior probabilities (nats).

inline constexpr double kNoSuchSize = 1e9;  ///< price of a size that no fault of the kind has
inline constexpr double kMostLoss = 1.2;    ///< share of the torque: a larger loss is an error of the fit
inline constexpr double kBeyondLoss = 2e4;  ///< price for each share of the torque lost beyond kMostLoss
inline constexpr double kStillJoint = 3.0;  ///< price of a joint, or of a position, that does not move
inline constexpr double kForcedRow = 1.2;   ///< price of each row that an unknown force explains
inline constexpr double kRepeatedReading = 2.0;  ///< price of each repeated position of a locked joint
inline constexpr int kMostRepeats = 500;         ///< repeated positions that count for a stuck encoder
inline constexpr double kStuckShare = 0.98;      ///< least share of positions that a stuck encoder repeats
inline constexpr double kFreeShare = 0.9;        ///< share of the torque lost: more is a free joint
inline constexpr double kFormShare = 0.05;  ///< share of its effect that a known (no unknown) fault may miss

inline constexpr double kStandsOut = 8.0;      ///< nats from which an onset stands out
inline constexpr double kWorthRefining = 5.0;  ///< nats from which an onset is refined
inline constexpr double kMayWin = 0.3;         ///< share of the best evidence below which none is refined

}  // namespace faultline
