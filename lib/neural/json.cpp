// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "lib/core/enum_named.hpp"
#include "lib/core/error.hpp"
#include "lib/core/json/json_matrix.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"
#include "lib/neural/rbfn.hpp"

namespace faultline {

using nlohmann::json;

void to_json(json& out, const Scaler& scaler) {
  out = {{"offset", vector_to_json(scaler.offset)}, {"factor", vector_to_json(scaler.factor)}};
}

Scaler scaler_from_json(const json& in, const std::string& where) {
  Scaler scaler{vector_from_json(in, "offset", where), vector_from_json(in, "factor", where)};
  if (scaler.offset.size() != scaler.factor.size() || (scaler.factor.array() == 0.0).any())
    throw Error(ErrorCode::input, where, "scaler: needs as many factors as offsets, none of them 0");
  return scaler;
}

void to_json(json& out, const Mlp& mlp) {
  json layers = json::array();
  for (const MlpLayer& layer : mlp.layers)
    layers.push_back({{"weights", matrix_to_json(layer.weights)}, {"bias", vector_to_json(layer.bias)}});
  out = {{"hidden", "tanh"}, {"output", to_string(mlp.output)}, {"layers", std::move(layers)}};
}

Mlp mlp_from_json(const json& in, const std::string& where) {
  Mlp mlp;
  const std::string output = text_from_json(in, "output", where);
  const auto kind = enum_named(output, {OutputKind::linear, OutputKind::logistic, OutputKind::softmax});
  if (!kind)
    throw Error(ErrorCode::input, where, "output: '" + output + "' is none of linear, logistic, softmax");
  mlp.output = *kind;
  const json& layers = member_of(in, "layers", where);
  if (!layers.is_array() || layers.empty())
    throw Error(ErrorCode::input, where, "layers: expected a list of layers");
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const std::string here = fmt::format("{}, layer {}", where, l + 1);
    MlpLayer layer{matrix_from_json(layers[l], "weights", here), vector_from_json(layers[l], "bias", here)};
    if (layer.weights.size() == 0 || layer.bias.size() != layer.weights.rows() ||
        (l > 0 && layer.weights.cols() != mlp.layers.back().weights.rows()))
      throw Error(ErrorCode::input, here,
                  fmt::format("{} x {} weights and {} biases do not match each other or the layer before",
                              layer.weights.rows(), layer.weights.cols(), layer.bias.size()));
    mlp.layers.push_back(std::move(layer));
  }
  return mlp;
}

void to_json(json& out, const Rbfn& rbfn) {
  out = {{"centres", matrix_to_json(rbfn.centres)},
         {"inverse_radii", matrix_to_json(rbfn.inverse_radii)},
         {"weights", matrix_to_json(rbfn.weights)},
         {"bias", vector_to_json(rbfn.bias)}};
}

Rbfn rbfn_from_json(const json& in, const std::string& where) {
  Rbfn rbfn{matrix_from_json(in, "centres", where), matrix_from_json(in, "inverse_radii", where),
            matrix_from_json(in, "weights", where), vector_from_json(in, "bias", where)};
  if (rbfn.centres.size() == 0 || rbfn.inverse_radii.rows() != rbfn.centres.rows() ||
      rbfn.inverse_radii.cols() != rbfn.centres.cols() || rbfn.weights.cols() != rbfn.centres.cols() ||
      rbfn.bias.size() != rbfn.weights.rows())
    throw Error(
        ErrorCode::input, where,
        fmt::format(
            "{} x {} centres, {} x {} inverse radii, {} x {} weights and {} biases do not match each other",
            rbfn.centres.rows(), rbfn.centres.cols(), rbfn.inverse_radii.rows(), rbfn.inverse_radii.cols(),
            rbfn.weights.rows(), rbfn.weights.cols(), rbfn.bias.size()));
  return rbfn;
}

}  // namespace faultline
