// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"

namespace faultline {

/// What became of the cases of a base in whose place another one steps.
struct CarriedCases {
  int carried = 0;     ///< cases that people added or revised, and of labelled logs that are not given again
  int recomputed = 0;  ///< of them: with the features that the new model gives the same fault of the same log
  int old_features = 0;  ///< of them: with the features of the earlier model
  int renumbered = 0;    ///< of them: under another id
  int replaced = 0;      ///< that `learn` had made and makes anew
};

/// True for a case that `learn` made and nobody has revised since.
bool is_made_by_learn(const Case& c);

/// Adds to `fresh`, which a new model came with, the cases of `old` that nothing can make again; of a
/// labelled log, where `fresh` has the same fault of the same log, in its place. A feature that `old` did not
/// have is not measured.
CarriedCases carry_over(const CaseBase& old, CaseBase& fresh);

}  // namespace faultline
