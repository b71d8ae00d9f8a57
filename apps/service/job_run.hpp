// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "apps/service/job.hpp"
#include "apps/service/service_folder.hpp"

namespace faultline {

/// Returns the path of this program: FAULTLINE_PROGRAM of the environment, which a script that starts it with
/// libraries of its own sets, else what the system says.
std::string own_program();

/// The process of a job.
struct JobProcess {
  std::string program = own_program();  ///< faultline
  double most_s = 3600.0;               ///< it is ended after this time
};

/// Runs the command of a job in its folder and returns how it ended. `goes_on` receives the progress and
/// returns false to end the job, whose outcome is then `cancelled`. A second run writes the same results.
/// Throws Error for a job that cannot be begun, such as one whose model is not there any more.
JobOutcome run_job(const ServiceFolder& folder, const Job& job, const JobProcess& process,
                   const std::function<bool(const std::string& step, double share)>& goes_on);

}  // namespace faultline
