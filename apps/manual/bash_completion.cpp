// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/manual/all_commands.hpp"
#include "apps/manual/completion.hpp"

namespace faultline {
namespace {

/// Adds each command of the line to the path, so that options belong to the innermost.
std::string bash_path_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : commands_with_words(program))
    text += fmt::format("      \"{}\") path=\"{}\" ;;\n", command->name, command->name);
  return text;
}

/// Returns the possible next words: commands, or options after a hyphen.
std::string bash_word_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : all_commands(program)) {
    std::string commands, flags;
    for (const CommandDescription& below : command->commands) commands += " " + below.own_name();
    for (const std::string& choice : argument_choices(*command)) commands += " " + choice;
    for (const ArgumentDescription& option : options_known_to(*command, program))
      flags += fmt::format(" {}", fmt::join(option.flags, " "));
    text += fmt::format("    \"{}\") commands=\"{}\" flags=\"{}\" ;;\n", command->name,
                        commands.empty() ? "" : commands.substr(1), flags.empty() ? "" : flags.substr(1));
  }
  return text;
}

/// Returns the values of options if they are few words, else nothing, so that the shell completes files.
std::string bash_value_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : all_commands(program))
    for (const ArgumentDescription& option : options_known_to(*command, program)) {
      if (option.value.empty()) continue;
      for (const std::string& flag : option.flags)
        text += fmt::format("    \"{} {}\") commands=\"{}\" flags=\"\" ;;\n", command->name, flag,
                            fmt::join(option.choices, " "));
    }
  return text;
}

}  // namespace

std::string bash_completion(const CommandDescription& program) {
  return "# bash completion of " + program.name + "\n_" + program.name +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} path=" +
         program.name +
         " commands= flags= i\n"
         "  if [[ $current == = ]]; then current=\n"
         "  elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$path ${COMP_WORDS[i]}\" in\n" +
         bash_path_cases(program) +
         "    esac\n"
         "  done\n"
         "  case \"$path\" in\n" +
         bash_word_cases(program) +
         "  esac\n"
         "  case \"$path $before\" in\n" +
         bash_value_cases(program) +
         "  esac\n"
         "  [[ $current == -* ]] && commands=$flags\n"
         "  COMPREPLY=($(compgen -W \"$commands\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _" +
         program.name + " " + program.name + "\n";
}

}  // namespace faultline
