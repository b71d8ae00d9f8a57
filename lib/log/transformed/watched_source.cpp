// SPDX-License-Identifier: MIT
#include "lib/log/transformed/watched_source.hpp"

#include <utility>

#include "lib/log/transformed/changed_source.hpp"

namespace faultline {
namespace {

class WatchedSource : public ChangedSource {
 public:
  WatchedSource(std::unique_ptr<LogSource> log, std::function<void(double)> watch)
      : ChangedSource(std::move(log)), watch_(std::move(watch)) {}

  bool next(Log& segment) override {
    const bool more = source_.next(segment);
    watch_(source_.share_read());
    return more;
  }

 private:
  std::function<void(double)> watch_;
};

}  // namespace

std::unique_ptr<LogSource> watched_log(std::unique_ptr<LogSource> log, std::function<void(double)> watch) {
  return std::make_unique<WatchedSource>(std::move(log), std::move(watch));
}

}  // namespace faultline
