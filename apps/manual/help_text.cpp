// SPDX-License-Identifier: MIT
#include "apps/manual/help_text.hpp"

#include <fmt/format.h>

#include <sstream>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr int kHelpWidth = 100;
constexpr int kHelpIndent = 30;

/// Returns the title and beside it, or below a long one, the words.
std::string entry(const std::string& title, const std::string& words) {
  const std::string indent(kHelpIndent, ' ');
  std::string text = "  " + title;
  const std::string help = wrapped(words, indent, kHelpWidth);
  if (help.empty()) return text + "\n";
  if (text.size() + 1 >= indent.size()) return text + "\n" + help;
  return text + help.substr(text.size());
}

std::string entries(const std::string& heading, const std::vector<ArgumentDescription>& arguments) {
  std::string text;
  for (const ArgumentDescription& argument : arguments) text += entry(title_of(argument), argument.help);
  return text.empty() ? "" : "\n" + heading + ":\n" + text;
}

std::string commands_of(const CommandDescription& command) {
  std::string text;
  for (const CommandDescription& below : command.commands) text += entry(below.own_name(), below.about);
  return text.empty() ? "" : "\nCommands:\n" + text;
}

std::string footer_of(const CommandDescription& command) {
  std::istringstream lines(command.footer);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += wrapped(line, "", kHelpWidth);
  return text.empty() ? "" : "\n" + text;
}

}  // namespace

std::string usage_of(const CommandDescription& command) {
  std::string usage = command.name + " [OPTIONS]";
  for (const ArgumentDescription& argument : command.positionals) {
    const std::string name = argument.value + (argument.repeated ? "..." : "");
    usage += argument.required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) usage += command.commands_required ? " COMMAND" : " [COMMAND]";
  return usage;
}

std::string title_of(const ArgumentDescription& argument) {
  std::string title = fmt::format("{}", fmt::join(argument.flags, ","));
  if (!argument.value.empty()) title += title.empty() ? argument.value : " " + argument.value;
  if (!argument.choices.empty()) title += fmt::format(":{{{}}}", fmt::join(argument.choices, ","));
  if (!argument.preset.empty()) title += "=" + argument.preset;
  if (argument.repeated) title += " ...";
  return title + (argument.required ? " REQUIRED" : "");
}

std::string help_text(const CommandDescription& command) {
  return command.about + "\nUsage: " + usage_of(command) + "\n" +
         entries("Positionals", command.positionals) + entries("Options", command.options) +
         commands_of(command) + footer_of(command);
}

}  // namespace faultline
