// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnose/diagnosis.hpp"
#include "lib/report/fact_table.hpp"

namespace faultline {

/// Table of the effects of the day that the log determines, one row each; empty if it determines none.
FactTable condition_table(const Diagnosis& diagnosis);

}  // namespace faultline
