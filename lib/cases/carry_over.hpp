// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Counts of the cases of a base that another base replaces.
struct CarriedCases {
  int carried = 0;     ///< cases that people added or revised, and of labelled logs that are no longer given
  int recomputed = 0;  ///< of these, with the new model's features of the same fault of the same log
  int old_features = 0;  ///< of these, with the features of the earlier model
  int renumbered = 0;    ///< of these, under another id
  int replaced = 0;      ///< cases made by `learn` that it made again
};

/// Whether `learn` made the case and it has not been revised since.
bool is_made_by_learn(const Case& c);

/// Adds to `fresh`, the base of a new model, the cases of `old` that `learn` cannot make again. Such a case
/// takes the place of the case of `fresh` with the same fault of the same labelled log. Features that `old`
/// does not have become NaN.
CarriedCases carry_over(const CaseBase& old, CaseBase& fresh);

}  // namespace faultline
