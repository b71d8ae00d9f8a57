// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lib/cases/carry_over.hpp"
#include "lib/learn/learn.hpp"

namespace faultline {

/// What was learned, for a person: parameters, how good the model is, and where both files are.
std::string learned_text(const Learned& learned, const std::string& model_path,
                         const std::string& case_base_path);

/// Schema "faultline/learning/1".
std::string learned_json(const Learned& learned, const std::optional<CarriedCases>& carried = {});

}  // namespace faultline
