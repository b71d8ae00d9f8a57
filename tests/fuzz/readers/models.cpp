// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "lib/model/model.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"
#include "lib/neural/rbfn.hpp"
#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

void feed_model(const std::string& bytes) {
  read_or_refuse([&] {
    const Model model = model_from_json(bytes, "model.json");
    demand(!model_to_json(model).empty(), "a model that was read can be written");
  });
}

void feed_network(const std::string& bytes) {
  const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
  if (json.is_discarded()) return;
  read_or_refuse([&] { mlp_from_json(json, "network.json"); });
  read_or_refuse([&] { rbfn_from_json(json, "network.json"); });
  read_or_refuse([&] { scaler_from_json(json, "network.json"); });
}

}  // namespace faultline
