// SPDX-License-Identifier: MIT
#include "apps/manual/all_commands.hpp"

#include <algorithm>

namespace faultline {

std::vector<const CommandDescription*> all_commands(const CommandDescription& command) {
  std::vector<const CommandDescription*> all{&command};
  for (const CommandDescription& below : command.commands)
    for (const CommandDescription* one : all_commands(below)) all.push_back(one);
  return all;
}

std::vector<ArgumentDescription> options_known_to(const CommandDescription& command,
                                                  const CommandDescription& program) {
  std::vector<ArgumentDescription> options = command.options;
  for (const ArgumentDescription& general : program.options) {
    const bool own = std::any_of(options.begin(), options.end(), [&](const ArgumentDescription& option) {
      return option.flags.back() == general.flags.back();
    });
    if (!own && !general.value.empty()) options.push_back(general);
  }
  return options;
}

}  // namespace faultline
