// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/service/service.hpp"

namespace faultline {
namespace {

constexpr int kMostPort = 65535;
constexpr double kMostMinutes = 10080.0;  // a week
constexpr double kSecondsPerMinute = 60.0;
constexpr int kMostMegabytes = 1 << 20;
constexpr int kMostWorkers = 256;

struct ServeArguments {
  ServiceOptions service;
  double most_minutes = 60.0;
  int most_mb = 2048;
};

int run_serve(const ServeArguments& arguments) {
  ServiceOptions options = arguments.service;
  options.queue.process.most_s = kSecondsPerMinute * arguments.most_minutes;
  options.form.most_file_bytes = static_cast<std::size_t>(arguments.most_mb) << 20;
  Service service(options);
  std::string host =
      options.address.find(':') != std::string::npos ? "[" + options.address + "]" : options.address;
  if (options.address == "0.0.0.0" || options.address == "::") host = machine_name();
  print_message(fmt::format("the pages of {} are at http://{}:{}/ (end with Ctrl-C)", options.folder, host,
                            service.port()));
  if (!service.new_token().empty())
    print_message(fmt::format("the token to log in, shown only now: {}", service.new_token()));
  else if (service.needs_token())
    print_message("the token to log in is the one shown before; --new-token makes another");
  service.run();
  return kNothingFound;
}

}  // namespace

void add_serve(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<ServeArguments>();
  ServiceOptions& service = arguments->service;
  CLI::App* command =
      app.add_subcommand("serve", "Show a folder of models as web pages: drop a log, read the report");
  command
      ->add_option("DIR", service.folder, "Folder of the models; uploads and reports are kept in DIR/serve")
      ->required();
  command->add_option("--port", service.port, "Port to listen on, 0 = any that is free")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, kMostPort));
  command
      ->add_option("--address", service.address,
                   "Address to listen on; any but this machine's own needs a token, which is shown once")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      ->add_option("--host", service.hosts, "A name under which browsers reach the service (may be repeated)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_flag("--https", service.https,
                    "Browsers reach the service through a proxy with HTTPS; cookies are sent only there");
  command->add_flag("--new-token", service.new_token, "Make a new token, which ends all sessions");
  command->add_option("--workers", service.queue.workers, "Jobs at the same time, 0 = one per core")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, kMostWorkers));
  command->add_option("--most-mb", arguments->most_mb, "Largest upload, MB")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, kMostMegabytes));
  command->add_option("--most-minutes", arguments->most_minutes, "Longest time of a job")
      ->type_name("NUMBER")
      ->capture_default_str()
      ->check(CLI::Range(0.0, kMostMinutes));
  command->footer(
      "Jobs survive the end of the service: what had not ended runs again at the next start.\n"
      "Example: faultline serve robots");
  command->callback([arguments, &program] { program.run = [arguments] { return run_serve(*arguments); }; });
}

}  // namespace faultline
