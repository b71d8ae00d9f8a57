// SPDX-License-Identifier: MIT
#include "apps/manual/help_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "lib/core/text.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

constexpr int kHelpWidth = 100;
constexpr int kHelpIndent = 30;

/// Returns "faultline convert [OPTIONS] LOG OUT".
std::string usage_of(const CommandDescription& command) {
  std::string usage = command.name + " [OPTIONS]";
  for (const ArgumentDescription& argument : command.positionals) {
    const std::string name = argument.value + (argument.repeated ? "..." : "");
    usage += argument.required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) usage += command.commands_required ? " COMMAND" : " [COMMAND]";
  return usage;
}

/// Returns "-o,--output DIR", "--threads N=0", "--color {auto,always,never}".
std::string title_of(const ArgumentDescription& argument) {
  std::string title = fmt::format("{}", fmt::join(argument.flags, ","));
  if (!argument.value.empty()) title += title.empty() ? argument.value : " " + argument.value;
  if (!argument.choices.empty()) title += fmt::format(":{{{}}}", fmt::join(argument.choices, ","));
  if (!argument.preset.empty()) title += "=" + argument.preset;
  if (argument.repeated) title += " ...";
  return title + (argument.required ? " REQUIRED" : "");
}

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

/// Escapes backslashes, requests at the start of a line, and hyphens, so that roff prints the text unchanged.
std::string roff(const std::string& text) {
  std::string out;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_start = c == '\n';
  }
  return out;
}

std::string page_name(const std::string& command) {
  std::string name = command;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string arguments_section(const char* heading, const std::vector<ArgumentDescription>& arguments) {
  std::string text;
  for (const ArgumentDescription& argument : arguments)
    text += ".TP\n.B " + roff(title_of(argument)) + "\n" + roff(argument.help) + "\n";
  return text.empty() ? "" : fmt::format(".SH {}\n{}", heading, text);
}

std::string commands_section(const CommandDescription& command) {
  std::string text;
  for (const CommandDescription& below : command.commands)
    text += fmt::format(".TP\n.BR {} (1)\n{}\n", roff(page_name(below.name)), roff(below.about));
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

/// Returns the paragraphs of the footer; an example in a section of its own.
std::string notes_section(const CommandDescription& command) {
  static const std::string kExample = "Example: ";
  std::istringstream lines(command.footer);
  std::string notes, examples;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kExample))
      examples += ".PP\n.EX\n" + roff(line.substr(kExample.size())) + "\n.EE\n";
    else if (!line.empty())
      notes += roff(line) + "\n";
  }
  return (notes.empty() ? "" : ".SH NOTES\n" + notes) + (examples.empty() ? "" : ".SH EXAMPLES\n" + examples);
}

std::string see_also(const std::string& command) {
  const auto parent = command.rfind(' ');
  if (parent == std::string::npos) return "";
  return fmt::format(".SH SEE ALSO\n.BR {} (1)\n", roff(page_name(command.substr(0, parent))));
}

ManPage page_of(const CommandDescription& command) {
  const std::string name = page_name(command.name);
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  std::string text =
      fmt::format(".TH {} 1 \"\" \"faultline {}\" \"faultline\"\n", roff(title), program_version());
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(command.about));
  text += fmt::format(".SH SYNOPSIS\n.B {}\n", roff(usage_of(command)));
  text += arguments_section("ARGUMENTS", command.positionals);
  text += arguments_section("OPTIONS", command.options);
  text += commands_section(command) + notes_section(command) + see_also(command.name);
  return {name + ".1", text};
}

}  // namespace

std::string help_text(const CommandDescription& command) {
  return command.about + "\nUsage: " + usage_of(command) + "\n" +
         entries("Positionals", command.positionals) + entries("Options", command.options) +
         commands_of(command) + footer_of(command);
}

std::vector<ManPage> man_pages(const CommandDescription& command) {
  std::vector<ManPage> pages{page_of(command)};
  for (const CommandDescription& below : command.commands)
    for (ManPage& page : man_pages(below)) pages.push_back(std::move(page));
  return pages;
}

}  // namespace faultline
