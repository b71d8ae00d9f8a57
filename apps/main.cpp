// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <new>
#include <regex>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "apps/commands.hpp"
#include "apps/manual/help_text.hpp"
#include "apps/manual/unknown_word.hpp"
#include "apps/options.hpp"
#include "apps/terminal.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/removed_on_signal.hpp"
#include "lib/core/version.hpp"

namespace faultline {
namespace {

/// Keeps freed memory instead of returning it to the system: matrices of some MB that are allocated again and
/// again would otherwise be cleared page by page, which takes an eighth of the time of a diagnosis.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
#endif
}

void add_global_options(CLI::App& app, Program& program) {
  app.set_version_flag("--version", std::string("faultline ") + program_version());
  add_choice_option(
      app, "--color", {"auto", "always", "never"},
      [&program](std::size_t place) { program.color = static_cast<ColorChoice>(place); },
      "Colours: auto (default), always or never; NO_COLOR is respected")
      ->type_name("WHEN");
  app.fallthrough();  // --color may also stand after the subcommand
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 nothing wrong found, 1 findings, 2 usage or option file, 3 an input cannot be\n"
      "processed or a result not written, 4 internal error.");
}

void add_commands(CLI::App& app, Program& program) {
  for (const auto add :
       {add_inspect, add_convert, add_cases, add_model, add_simulate, add_identify, add_learn, add_diagnose,
        add_compare, add_batch, add_history, add_serve, add_golden, add_reproduce, add_help, add_completion})
    add(app, program);
}

/// Returns the innermost command that was named, with the words before it.
CommandDescription selected_command(const CLI::App& app) {
  const CLI::App* command = &app;
  std::string prefix;
  while (!command->get_subcommands().empty()) {
    prefix += command->get_name() + " ";
    command = command->get_subcommands().back();
  }
  return describe_command(*command, prefix);
}

/// Replaces a range whose upper limit the library prints as the largest double with all its digits.
std::string without_limits_of_double(const std::string& sentence) {
  static const std::regex limits("not in range [0-9.]+ to 1[0-9]{300,}[0-9.]*");
  return std::regex_replace(sentence, limits, "is too small");
}

/// Returns the library's message about a command line; for an unknown word, a message with the nearest name.
std::string about_parse_error(const CLI::App& app, const CLI::ParseError& error,
                              const std::vector<std::string>& words) {
  const CommandDescription command = selected_command(app);
  std::string sentence = about_unknown_word(describe_command(app), words);
  if (sentence.empty() && dynamic_cast<const CLI::ExtrasError*>(&error))
    sentence = about_further_word(command);
  if (sentence.empty()) sentence = without_limits_of_double(error.what());
  return sentence + "; see '" + command.name + " --help'";
}

int run(int argc, char** argv) {
  keep_freed_memory();
  CLI::App app("Fault diagnosis of SCARA robots from recorded joint logs.", "faultline");
  Program program;
  add_global_options(app, program);
  add_commands(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(help_text(selected_command(app)));
    return kNothingFound;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return kNothingFound;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::usage, "command line", about_parse_error(app, error, {argv + 1, argv + argc}));
  }
  return program.run();
}

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return kUsageError;
    case ErrorCode::input:
    case ErrorCode::output:
      return kFileError;
    case ErrorCode::internal:
      return kInternalError;
  }
  return kInternalError;
}

int fail(int status, const std::string& sentence) {
  print_message(sentence);
  return status;
}

}  // namespace

void set_work(CLI::App& command, Program& program, std::function<int(ColorChoice)> work) {
  command.callback(
      [&program, work = std::move(work)] { program.run = [&program, work] { return work(program.color); }; });
}

int guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const Error& error) {
    return fail(status_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(kInternalError,
                "the machine has too little free memory for this; use a shorter log, or free some memory");
  } catch (const std::exception& error) {
    return fail(kInternalError,
                std::string("internal error, please report it with the command line: ") + error.what());
  }
}

}  // namespace faultline

int main(int argc, char** argv) {
  faultline::prepare_standard_streams();
  faultline::remove_files_on_signals();
  return faultline::guarded([&] { return faultline::run(argc, argv); });
}
