// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "lib/diagnose/diagnosis.hpp"

/// Similar cases in words, the same in every report for people.
namespace faultline {

/// "Similar cases", and what all of them are where none was confirmed in the field.
std::string precedents_title(const FaultFinding& fault);

/// Value of a feature with its unit, such as "12 times healthy".
std::string feature_value_text(double value, const std::string& unit);

/// "alike: MLP residual of joint 2 (here 12, there 14 times healthy); unlike: ...", at most `most` of each;
/// empty where nothing was compared.
std::string likeness_words(const Precedent& precedent, std::size_t most);

/// "12 field 0.83", as in the table for programs.
std::string precedent_code(const Precedent& precedent);

}  // namespace faultline
