// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <vector>

#include "apps/manual/help_text.hpp"

namespace faultline {
namespace {

/// Returns render(name) of each command that determines the meaning of the words after it.
template <typename Render>
std::string path_cases(const CommandDescription& program, Render render) {
  std::string text;
  for (const CommandDescription* command : commands_with_words(program)) text += render(command->name);
  return text;
}

/// Returns render("faultline COMMAND FLAG", values) of each flag that takes a value.
template <typename Render>
std::string value_cases(const CommandDescription& program, Render render) {
  std::string text;
  for (const CommandDescription* command : all_commands(program))
    for (const ArgumentDescription& option : options_known_to(*command, program))
      for (const std::string& flag : option.value.empty() ? std::vector<std::string>{} : option.flags)
        text += render(command->name + " " + flag, fmt::format("{}", fmt::join(option.choices, " ")));
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

/// Returns the text in single quotes.
std::string zsh_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
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

// Bash: each command of the line is added to the path, so that options belong to the innermost; where no word
// is offered, the shell completes files.
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
         path_cases(
             program,
             [](const std::string& name) { return fmt::format("      \"{0}\") path=\"{0}\" ;;\n", name); }) +
         "    esac\n"
         "  done\n"
         "  case \"$path\" in\n" +
         bash_word_cases(program) +
         "  esac\n"
         "  case \"$path $before\" in\n" +
         value_cases(program,
                     [](const std::string& words, const std::string& values) {
                       return fmt::format("    \"{}\") commands=\"{}\" flags=\"\" ;;\n", words, values);
                     }) +
         "  esac\n"
         "  [[ $current == -* ]] && commands=$flags\n"
         "  COMPREPLY=($(compgen -W \"$commands\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _" +
         program.name + " " + program.name + "\n";
}

std::string zsh_completion(const CommandDescription& program) {
  return "#compdef " + program.name + "\n_" + program.name +
         "() {\n"
         "  local typed=" +
         program.name +
         " i\n"
         "  local -a commands options\n"
         "  for ((i = 2; i < CURRENT; ++i)); do\n"
         "    case \"$typed $words[i]\" in\n" +
         path_cases(
             program,
             [](const std::string& name) { return fmt::format("      ('{0}') typed='{0}' ;;\n", name); }) +
         "    esac\n"
         "  done\n"
         "  case \"$typed $words[CURRENT-1]\" in\n" +
         value_cases(program,
                     [](const std::string& words, const std::string& values) {
                       return fmt::format("    ('{}') {}; return ;;\n", words,
                                          values.empty() ? "_files" : "compadd " + values);
                     }) +
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
