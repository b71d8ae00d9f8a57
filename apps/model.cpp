// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "lib/core/text.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {
namespace {

struct SignArguments {
  std::string model, why;
};

int run_sign(const SignArguments& arguments) {
  if (!sign_model(arguments.model, arguments.why)) {
    print(printable(arguments.model) + " matches its digest; there is nothing to sign" +
          (arguments.why.empty() ? ".\n" : ", and --why is not kept.\n"));
    return kNothingFound;
  }
  print(printable(arguments.model) +
        " is accepted as it is now; each report made with it states that it was edited.\n");
  return kNothingFound;
}

}  // namespace

void add_model(CLI::App& app, Program& program) {
  CLI::App* model = app.add_subcommand("model", "Accept a model that was edited by hand");
  model->require_subcommand(1);
  auto arguments = std::make_shared<SignArguments>();
  CLI::App* sign = model->add_subcommand(
      "sign", "Accept a model that was edited on purpose and no longer matches its digest");
  sign->add_option("MODEL", arguments->model, "The model; it is changed in place")->required();
  sign->add_option("--why", arguments->why, "What was edited and why; shown in each report")
      ->type_name("TEXT");
  sign->footer(
      "Example: faultline model sign robot.model --why \"higher alarm threshold for the night shift\"");
  sign->callback([arguments, &program] { program.run = [arguments] { return run_sign(*arguments); }; });
  model->footer("Example: faultline model sign robot.model --why \"higher alarm threshold\"");
}

}  // namespace faultline
