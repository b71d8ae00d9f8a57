// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/service/job_queue.hpp"
#include "apps/service/service_folder.hpp"

namespace faultline {

/// A folder for the files of one job that is not yet in the queue, with the subfolder `logs`. It is removed
/// with the object, unless the queue has taken it.
class Incoming {
 public:
  /// Throws Error(output).
  explicit Incoming(const ServiceFolder& folder);
  ~Incoming();
  Incoming(const Incoming&) = delete;
  Incoming& operator=(const Incoming&) = delete;

  /// Path of a file in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::string log(const std::string& name) const { return path_ + "/logs/" + name; }
  /// Gives the folder to the queue as a new job, received now.
  Job add_to(JobQueue& queue, JobRequest request);

 private:
  std::string path_;
};

}  // namespace faultline
