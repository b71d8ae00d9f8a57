// SPDX-License-Identifier: MIT
#include "lib/log/columns/joint_count.hpp"

#include <fmt/format.h>

#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"

namespace faultline {

std::string joint_count_sentence(const Issues& issues, int found, const std::string& whose, int wanted) {
  const std::string has = counted(found, "joint"), first = to_string({Quantity::q, found + 1});
  if (found > wanted)
    return fmt::format("is a log of another robot: it has {}, but {} has {}", has, whose, wanted);
  if (const Issue* missing = issues.find("channel_missing", first))
    return fmt::format("has positions of {} only, but {} has {}: {}", has, whose, wanted, missing->message);
  const std::string last = to_string({Quantity::q, wanted});
  return fmt::format(
      "has positions of {}, but {} has {}: it is a log of another robot, or {} not found among its columns; "
      "name such columns in the robot file: [log.columns] {} = {{name = \"...\"}}",
      has, whose, wanted, first == last ? first + " was" : first + " to " + last + " were", first);
}

}  // namespace faultline
