// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace faultline {

/// An option or a positional argument of a command, as shown in its help.
struct ArgumentDescription {
  std::vector<std::string> flags{};    ///< "-o", "--output"; empty for a positional argument
  std::string value{};                 ///< its value, such as "LOG" or "N"; empty for a switch
  std::vector<std::string> choices{};  ///< the only values, if they are few words
  std::string preset{};                ///< default value; may be empty
  std::string help{};
  bool required = false;
  bool repeated = false;  ///< takes any number of values
};

/// A command and those below it; the source of help, man pages and completions.
struct CommandDescription {
  std::string name{};    ///< as it is typed: "faultline golden check"
  std::string about{};   ///< its purpose, in a line
  std::string footer{};  ///< notes, exit status, example; a paragraph per line
  std::vector<ArgumentDescription> positionals{};
  std::vector<ArgumentDescription> options{};
  std::vector<CommandDescription> commands{};
  bool commands_required = false;  ///< does nothing by itself

  /// The last word of the name: "check".
  std::string own_name() const { return name.substr(name.rfind(' ') + 1); }
};

/// Describes a command; `prefix` has the words before its own name, each followed by a blank. Hidden options
/// and commands (those of an empty group) are omitted.
CommandDescription describe_command(const CLI::App& command, const std::string& prefix = "");

/// Returns the command and all below it, each before those below it.
std::vector<const CommandDescription*> all_commands(const CommandDescription& command);

/// Returns the commands below the program that determine the meaning of the words after them; not `help`,
/// whose words name another command.
std::vector<const CommandDescription*> commands_with_words(const CommandDescription& program);

/// Returns the possible arguments of a command, if they are few words.
std::vector<std::string> argument_choices(const CommandDescription& command);

/// Returns the options of a command and those of `program` that take a value, which every command accepts.
std::vector<ArgumentDescription> options_known_to(const CommandDescription& command,
                                                  const CommandDescription& program);

}  // namespace faultline
