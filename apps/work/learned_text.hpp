// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lib/cases/carry_over.hpp"
#include "lib/learn/learn.hpp"

namespace faultline {

/// Returns the learned model for a person: parameters, quality of the model, and the paths of both files.
std::string learned_text(const Learned& learned, const std::string& model_path,
                         const std::string& case_base_path);

/// Returns JSON, schema "faultline/learning/1".
std::string learned_json(const Learned& learned, const std::optional<CarriedCases>& carried = {});

}  // namespace faultline
