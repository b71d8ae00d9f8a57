// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace faultline {

/// The JSON of a model as the programs wrote it that knew no digest.
inline std::string older_model_text(nlohmann::ordered_json model) {
  for (const char* later : {"digest", "identity", "edited"}) model.erase(later);
  model["schema"] = "faultline/model/2";
  return model.dump(1) + "\n";
}

}  // namespace faultline
