// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lib/model/model_text.hpp"

namespace faultline {

/// The text of a model whose JSON was changed, with a digest that fits.
inline std::string resealed_model_text(nlohmann::ordered_json model) {
  model.erase("digest");
  return sealed_model_text(model);
}

}  // namespace faultline
