// SPDX-License-Identifier: MIT
#include "apps/service/incoming.hpp"

#include <sys/stat.h>

#include <ctime>
#include <filesystem>

namespace faultline {

Incoming::Incoming(const ServiceFolder& folder) : path_(folder.new_incoming()) {
  ::mkdir((path_ + "/logs").c_str(), S_IRWXU);  // writing into it reports a failure
}

Incoming::~Incoming() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

Job Incoming::add_to(JobQueue& queue, JobRequest request) {
  request.received_s = std::time(nullptr);
  Job job = queue.add(path_, request);
  path_.clear();
  return job;
}

}  // namespace faultline
