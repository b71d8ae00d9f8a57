// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "apps/manual/all_commands.hpp"
#include "apps/manual/completion.hpp"

namespace faultline {
namespace {

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

/// Returns a shell function that prints the program and the commands typed so far, without other words.
std::string path_function(const CommandDescription& program) {
  std::string names;
  for (const CommandDescription* command : commands_with_words(program))
    names += " " + fish_quoted(command->name);
  return fmt::format(
      "function __{0}_typed\n"
      "  set -l typed {0}\n"
      "  for word in (commandline -opc)[2..-1]\n"
      "    contains -- \"$typed $word\"{1}; and set typed \"$typed $word\"\n"
      "  end\n"
      "  echo $typed\n"
      "end\n",
      program.name, names);
}

std::string flags_of(const ArgumentDescription& option) {
  std::string text;
  for (const std::string& flag : option.flags)
    text += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
  return text;
}

}  // namespace

std::string fish_completion(const CommandDescription& program) {
  std::string text = "# fish completion of " + program.name + "\n" + path_function(program);
  for (const CommandDescription* command : all_commands(program)) {
    const std::string here =
        fmt::format("complete -c {0} -n 'test (__{0}_typed) = \"{1}\"'", program.name, command->name);
    for (const CommandDescription& below : command->commands)
      text += fmt::format("{} -f -a {} -d {}\n", here, below.own_name(), fish_quoted(below.about));
    for (const std::string& choice : argument_choices(*command)) text += here + " -f -a " + choice + "\n";
    for (const ArgumentDescription& option : options_known_to(*command, program)) {
      std::string values = option.value.empty() ? "" : " -r";
      if (!option.choices.empty())
        values = fmt::format(" -x -a {}", fish_quoted(fmt::format("{}", fmt::join(option.choices, " "))));
      text += here + flags_of(option) + values + " -d " + fish_quoted(option.help) + "\n";
    }
  }
  return text;
}

}  // namespace faultline
