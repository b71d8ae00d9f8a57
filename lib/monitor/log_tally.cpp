// SPDX-License-Identifier: MIT
#include "lib/monitor/log_tally.hpp"

#include <cmath>
#include <string>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

void check_channels(const Log& segment, const LogSource& log, const Model& model) {
  const int joints = model.robot.joints();
  if (segment.joints() != joints)
    throw Error(ErrorCode::input, log.identity().path,
                "is a log of another robot: it has " + std::to_string(segment.joints()) +
                    " joints, the model \"" + model.name + "\" has " + std::to_string(joints));
  if (static_cast<int>(segment.tau.size()) != joints)
    throw Error(
        ErrorCode::input, log.identity().path,
        "has no torque (tau1..tau" + std::to_string(joints) +
            "), without which no fault can be judged; map the columns in [log.columns] of the robot file");
}

}  // namespace

void LogTally::take(const Log& segment, const LogSource& log, const Model& model) {
  check_channels(segment, log, model);
  assess(segment, quality);
  if (rows == 0 && segment.rows() > 0) start_s = segment.time.front();
  if (segment.rows() > 0) end_s = segment.time.back();
  rows += segment.rows();
  has_velocity = !segment.dq.empty();
  for (int k = 0; k < segment.rows(); ++k) {
    bool complete = true;
    for (int j = 0; j < segment.joints(); ++j)
      complete = complete && std::isfinite(segment.q[j][k]) && std::isfinite(segment.tau[j][k]);
    judgeable_rows += complete;
  }
}

}  // namespace faultline
