// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands.hpp"
#include "apps/manual/command_description.hpp"
#include "apps/manual/help_text.hpp"
#include "apps/manual/unknown_word.hpp"
#include "apps/options.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

struct HelpArguments {
  std::vector<std::string> command;  ///< its words, without "faultline"
  std::string man;                   ///< folder for the man pages
};

int write_man_pages(const CommandDescription& program, const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (const ManPage& page : man_pages(program))
    write_file((std::filesystem::path(folder) / page.name).string(), page.text);
  return kNothingFound;
}

int help(const CommandDescription& program, const HelpArguments& arguments) {
  if (!arguments.man.empty()) return write_man_pages(program, arguments.man);
  std::string name = program.name;
  for (const std::string& word : arguments.command) name += " " + word;
  for (const CommandDescription* command : all_commands(program))
    if (command->name == name) {
      print(help_text(*command));
      return kNothingFound;
    }
  const std::string unknown = about_unknown_word(program, arguments.command);
  throw Error(ErrorCode::usage, "command line", unknown.empty() ? name + " is not a command" : unknown);
}

}  // namespace

void add_help(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<HelpArguments>();
  CLI::App* command = app.add_subcommand("help", "Explain a command, its options and its exit status");
  command->add_option("COMMAND", arguments->command, "The command, such as diagnose or golden check");
  command->add_option("--man", arguments->man, "Write a man page of every command into this folder")
      ->type_name("DIR");
  command->footer("Example: faultline help golden check");
  command->callback([arguments, &app, &program] {
    program.run = [arguments, &app] { return help(describe_command(app), *arguments); };
  });
}

void add_completion(CLI::App& app, Program& program) {
  using Script = std::string (*)(const CommandDescription&);
  static constexpr Script kScripts[] = {bash_completion, zsh_completion, fish_completion};
  auto script = std::make_shared<Script>();
  CLI::App* command = app.add_subcommand("completion", "Print a script that completes commands in a shell");
  add_choice_option(
      *command, "SHELL", {"bash", "zsh", "fish"}, [script](std::size_t place) { *script = kScripts[place]; },
      "The shell")
      ->required();
  command->footer(
      "Example: faultline completion bash > ~/.local/share/bash-completion/completions/faultline");
  command->callback([script, &app, &program] {
    program.run = [script, &app] {
      print((*script)(describe_command(app)));
      return kNothingFound;
    };
  });
}

}  // namespace faultline
