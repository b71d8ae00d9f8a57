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

std::vector<const CommandDescription*> commands_with_words(const CommandDescription& program) {
  std::vector<const CommandDescription*> commands = all_commands(program);
  std::erase_if(commands, [&](const CommandDescription* command) {
    return command == &program || command->own_name() == "help";
  });
  return commands;
}

std::vector<std::string> argument_choices(const CommandDescription& command) {
  std::vector<std::string> choices;
  for (const ArgumentDescription& argument : command.positionals)
    choices.insert(choices.end(), argument.choices.begin(), argument.choices.end());
  return choices;
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
