// SPDX-License-Identifier: MIT
#include "lib/log/prefetch.hpp"

#include <array>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace faultline {
namespace {

constexpr int kSegmentsAhead = 4;

/// What is known of a log with the segment that was read last.
struct KnownOfLog {
  LogIdentity identity{};
  double share = std::numeric_limits<double>::quiet_NaN();  ///< read

  void take_from(const LogSource& source) {
    identity = source.identity();
    share = source.share_read();
  }
};

/// A ring of segments between the reading thread and the caller of next().
class PrefetchSource : public LogSource {
 public:
  explicit PrefetchSource(std::unique_ptr<LogSource> source) : source_(std::move(source)) {
    known_.take_from(*source_);
  }
  ~PrefetchSource() override { stop(); }

  bool next(Log& segment) override {
    if (!reader_.joinable() && !ended_ && !start_reader()) {
      const bool got = source_->next(segment);
      known_.take_from(*source_);
      return got;
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready_ > 0 || ended_; });
    if (ready_ > 0) {
      const auto place = static_cast<std::size_t>(taken_ % kSegmentsAhead);
      std::swap(segment, ring_[place].segment);
      std::swap(known_, ring_[place].known);
      ++taken_;
      --ready_;
      changed_.notify_all();
      return true;
    }
    lock.unlock();
    if (reader_.joinable()) reader_.join();
    known_.take_from(*source_);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return false;
  }

  void rewind() override {
    stop();
    source_->rewind();
    known_.take_from(*source_);
    taken_ = ready_ = 0;
    ended_ = stopping_ = false;
    failure_ = nullptr;
  }

  const LogIdentity& identity() const override { return known_.identity; }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return known_.share; }

 private:
  /// A segment that was read and not handed out.
  struct Ahead {
    Log segment;
    KnownOfLog known;
  };

  /// Returns false if no thread can be started.
  bool start_reader() {
    try {
      reader_ = std::thread([this] { read(); });
    } catch (const std::system_error&) {
      return false;
    }
    return true;
  }

  void read() {
    try {
      for (int number = 0;; ++number) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ready_ < kSegmentsAhead || stopping_; });
        if (stopping_) break;
        lock.unlock();
        const auto place = static_cast<std::size_t>(number % kSegmentsAhead);
        Ahead& ahead = ring_[place];
        const bool got = source_->next(ahead.segment);
        if (got) ahead.known.take_from(*source_);
        lock.lock();
        if (!got) break;
        ++ready_;
        changed_.notify_all();
      }
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      changed_.notify_all();
    }
    if (reader_.joinable()) reader_.join();
  }

  std::unique_ptr<LogSource> source_;
  KnownOfLog known_;  ///< with the segment handed out last; the reader is ahead of it
  std::thread reader_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Ahead, kSegmentsAhead> ring_;
  int taken_ = 0;  ///< segments handed out
  int ready_ = 0;  ///< segments read and not handed out
  bool ended_ = false;
  bool stopping_ = false;
  std::exception_ptr failure_;
};

}  // namespace

std::unique_ptr<LogSource> prefetched(std::unique_ptr<LogSource> source) {
  return std::make_unique<PrefetchSource>(std::move(source));
}

}  // namespace faultline
