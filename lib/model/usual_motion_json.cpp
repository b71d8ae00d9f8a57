// SPDX-License-Identifier: MIT
#include "lib/model/usual_motion_json.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/neural/json_matrix.hpp"

namespace faultline {
namespace {

/// Calls visit(key, vector) for every list that has one number a joint.
template <typename Usual, typename Visit>
void visit_joint_lists(Usual& usual, Visit visit) {
  visit("q_low", usual.q_low);
  visit("q_high", usual.q_high);
  visit("velocity_scale", usual.velocity_scale);
  visit("torque_scale", usual.torque_scale);
  visit("usual_bias", usual.sizes.bias);
  visit("usual_drift", usual.sizes.drift);
  visit("usual_viscous_increase", usual.sizes.viscous_increase);
  visit("usual_coulomb_increase", usual.sizes.coulomb_increase);
  visit("usual_external_torque", usual.sizes.external_torque);
}

void check_ranges(const UsualMotion& usual, const std::string& where) {
  for (std::size_t j = 0; j < usual.q_low.size(); ++j)
    if (!(usual.q_low[j] <= usual.q_high[j]))
      throw Error(ErrorCode::input, where,
                  "\"q_low\" of joint " + std::to_string(j + 1) +
                      " lies above its \"q_high\"; learn the model again");
}

}  // namespace

nlohmann::json usual_motion_to_json(const UsualMotion& usual) {
  nlohmann::json json = nlohmann::json::object();
  visit_joint_lists(usual, [&](const char* key, const auto& values) { json[key] = values; });
  json["usual_payload"] = usual.sizes.payload;
  return json;
}

UsualMotion usual_motion_from_json(const nlohmann::json& json, int joints, const std::string& where) {
  UsualMotion usual;
  visit_joint_lists(usual, [&](const char* key, std::vector<double>& values) {
    const Eigen::VectorXd read = vector_from_json(json, key, where);
    if (read.size() != joints)
      throw Error(ErrorCode::input, where,
                  std::string("\"") + key + "\" has " + std::to_string(read.size()) +
                      " numbers, expected one a joint (" + std::to_string(joints) +
                      "); learn the model again");
    values.assign(read.begin(), read.end());
  });
  check_ranges(usual, where);
  usual.sizes.payload = number_from_json(json, "usual_payload", where);
  return usual;
}

}  // namespace faultline
