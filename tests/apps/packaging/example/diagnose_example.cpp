// SPDX-License-Identifier: MIT
#include <faultline/formats/open_log.hpp>
#include <faultline/lib/core/error.hpp>
#include <faultline/lib/diagnose/diagnose.hpp>
#include <faultline/lib/model/model_files.hpp>
#include <iostream>

// Usage: diagnose_example LOG MODEL
int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  const std::string model_path = argv[2];
  const auto [model, cases] = faultline::load_model_files(model_path, model_path + ".cases.db");
  faultline::OpenLogOptions options;
  options.columns = model.robot.log.columns;
  const auto log = faultline::open_log(argv[1], options);
  const faultline::Diagnosis diagnosis = faultline::diagnose(*log, model, cases);
  std::cout << to_string(diagnosis.verdict) << '\n';
  for (const auto& fault : diagnosis.faults)
    std::cout << to_string(fault.label.kind) << ' ' << fault.label.joint.number() << ' ' << fault.onset_s
              << '\n';
  return 0;
} catch (const faultline::Error& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
