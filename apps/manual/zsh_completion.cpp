// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/manual/all_commands.hpp"
#include "apps/manual/completion.hpp"

namespace faultline {
namespace {

/// Returns the text in single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string zsh_path_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : commands_with_words(program))
    text += fmt::format("      ('{0}') typed='{0}' ;;\n", command->name);
  return text;
}

/// Returns a word with its help for _describe, separated by a colon.
std::string offered(const std::string& word, const std::string& help) {
  return " " + zsh_quoted(word + ":" + help.substr(0, help.find('\n')));
}

std::string zsh_word_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : all_commands(program)) {
    std::string commands, options;
    for (const CommandDescription& below : command->commands)
      commands += offered(below.own_name(), below.about);
    for (const std::string& choice : argument_choices(*command)) commands += " " + zsh_quoted(choice);
    for (const ArgumentDescription& option : options_known_to(*command, program))
      for (const std::string& flag : option.flags) options += offered(flag, option.help);
    text += fmt::format("    ('{}')\n      commands=({})\n      options=({}) ;;\n", command->name, commands,
                        options);
  }
  return text;
}

std::string zsh_value_cases(const CommandDescription& program) {
  std::string text;
  for (const CommandDescription* command : all_commands(program))
    for (const ArgumentDescription& option : options_known_to(*command, program)) {
      if (option.value.empty()) continue;
      const std::string values =
          option.choices.empty() ? "_files" : fmt::format("compadd {}", fmt::join(option.choices, " "));
      for (const std::string& flag : option.flags)
        text += fmt::format("    ('{} {}') {}; return ;;\n", command->name, flag, values);
    }
  return text;
}

}  // namespace

std::string zsh_completion(const CommandDescription& program) {
  return "#compdef " + program.name + "\n_" + program.name +
         "() {\n"
         "  local typed=" +
         program.name +
         " i\n"
         "  local -a commands options\n"
         "  for ((i = 2; i < CURRENT; ++i)); do\n"
         "    case \"$typed $words[i]\" in\n" +
         zsh_path_cases(program) +
         "    esac\n"
         "  done\n"
         "  case \"$typed $words[CURRENT-1]\" in\n" +
         zsh_value_cases(program) +
         "  esac\n"
         "  case $typed in\n" +
         zsh_word_cases(program) +
         "  esac\n"
         "  if [[ $words[CURRENT] == -* ]]; then _describe -o option options\n"
         "  elif (( $#commands )); then _describe command commands\n"
         "  else _files; fi\n"
         "}\n"
         "_" +
         program.name + " \"$@\"\n";
}

}  // namespace faultline
