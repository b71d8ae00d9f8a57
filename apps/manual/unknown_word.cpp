// SPDX-License-Identifier: MIT
#include "apps/manual/unknown_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace faultline {
namespace {

/// Returns the optimal string alignment distance.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      edits[i][j] = i + j;
      if (i == 0 || j == 0) continue;
      edits[i][j] = std::min(
          {edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits.back().back();
}

std::string did_you_mean(const std::string& nearest) {
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::vector<std::string> flags_of(const CommandDescription& command) {
  std::vector<std::string> flags;
  for (const ArgumentDescription& option : command.options)
    flags.insert(flags.end(), option.flags.begin(), option.flags.end());
  return flags;
}

const ArgumentDescription* option_named(const CommandDescription& command, const std::string& flag) {
  for (const ArgumentDescription& option : command.options)
    if (std::find(option.flags.begin(), option.flags.end(), flag) != option.flags.end()) return &option;
  return nullptr;
}

std::string no_command(const CommandDescription& command, const std::string& word) {
  std::vector<std::string> names;
  for (const CommandDescription& below : command.commands) names.push_back(below.own_name());
  const std::string nearest = nearest_name(word, names);
  if (!nearest.empty())
    return fmt::format("{} {} is not a command; did you mean {} {}?", command.name, word, command.name,
                       nearest);
  return fmt::format("{} {} is not a command; there are {}", command.name, word, fmt::join(names, ", "));
}

bool is_number(const std::string& word) {
  return word.find_first_not_of("+-.0123456789eE") == std::string::npos;
}

}  // namespace

std::string nearest_name(const std::string& typed, const std::vector<std::string>& names) {
  constexpr std::size_t kLettersAnEdit = 3;  // so that short words are near to few names
  std::string nearest;
  std::size_t fewest = typed.size() / kLettersAnEdit + 1;
  for (const std::string& name : names) {
    const bool begun = typed.size() >= kLettersAnEdit && name.starts_with(typed);
    const std::size_t edits = begun ? 0 : edits_between(typed, name);
    if (edits <= fewest && (nearest.empty() || edits < fewest)) {
      nearest = name;
      fewest = edits;
    }
  }
  return nearest;
}

std::string about_unknown_word(const CommandDescription& program, const std::vector<std::string>& words) {
  const CommandDescription* command = &program;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--") return "";
    if (word.size() > 1 && word.front() == '-') {
      const std::string flag = word.substr(0, word.find('='));
      const ArgumentDescription* option = option_named(*command, flag);
      if (!option) option = option_named(program, flag);
      const bool is_long = word[1] == '-';
      if (!option && is_long)
        return fmt::format("{} is not an option of {}{}", flag, command->name,
                           did_you_mean(nearest_name(flag, flags_of(*command))));
      if (!option && word.find('.') != std::string::npos && !is_number(word))
        return fmt::format("{} is not an option of {}; a file of that name is given as ./{}", word,
                           command->name, word);
      if (option && !option->value.empty() && flag == word) ++i;  // its value
      continue;
    }
    const auto below = std::find_if(command->commands.begin(), command->commands.end(),
                                    [&](const CommandDescription& c) { return c.own_name() == word; });
    if (below != command->commands.end())
      command = &*below;
    else if (command->commands_required)
      return no_command(*command, word);
  }
  return "";
}

std::string about_further_word(const CommandDescription& command) {
  if (command.own_name() != "diagnose") return "";
  return "diagnose takes one log; for several runs: faultline batch LOG... --model MODEL -o DIR; for one "
         "run in several files: --join or --then";
}

}  // namespace faultline
