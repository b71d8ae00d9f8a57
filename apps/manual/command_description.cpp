// SPDX-License-Identifier: MIT
#include "apps/manual/command_description.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace faultline {
namespace {

/// Returns "{evidence,samples}" in "TEXT:{evidence,samples}" as words.
std::vector<std::string> choices_in(const std::string& type) {
  const auto begin = type.find('{'), end = type.rfind('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream words(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

/// Returns the value of an option without the checks that the library appends after a colon.
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string name = type.substr(0, type.find(':'));
  if (name == "INT" || name == "UINT") return "N";
  return name == "FLOAT" ? "NUMBER" : name;
}

ArgumentDescription describe(const CLI::Option& option) {
  ArgumentDescription argument;
  for (const std::string& name : option.get_snames()) argument.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.flags.push_back("--" + name);
  if (option.get_positional()) argument.value = option.get_name(true);
  if (!option.get_positional() && option.get_items_expected_max() > 0) argument.value = value_of(option);
  argument.choices = choices_in(option.get_type_name());
  argument.preset = option.get_default_str();
  argument.help = option.get_description();
  argument.required = option.get_required();
  argument.repeated = option.get_items_expected_max() > 1;
  return argument;
}

/// Adds the options of a parent command that does nothing by itself, such as `cases`.
void add_options_before(const CLI::App& command, CommandDescription& described) {
  const CLI::App* before = command.get_parent();
  if (!before || !before->get_parent() || before->get_require_subcommand_min() == 0) return;
  for (const CLI::Option* option : before->get_options())
    if (option != before->get_help_ptr()) described.options.push_back(describe(*option));
}

}  // namespace

CommandDescription describe_command(const CLI::App& command, const std::string& prefix) {
  CommandDescription described;
  described.name = prefix + command.get_name();
  described.about = command.get_description();
  described.footer = command.get_footer();
  described.commands_required = command.get_require_subcommand_min() > 0;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      (option->get_positional() ? described.positionals : described.options).push_back(describe(*option));
  add_options_before(command, described);
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    if (!below->get_group().empty())
      described.commands.push_back(describe_command(*below, described.name + " "));
  return described;
}

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
