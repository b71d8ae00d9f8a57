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

/// A ring of segments between the reading thread and the caller of next().
class PrefetchSource : public LogSource {
 public:
  explicit PrefetchSource(std::unique_ptr<LogSource> source)
      : source_(std::move(source)), identity_(source_->identity()) {}
  ~PrefetchSource() override { stop(); }

  bool next(Log& segment) override {
    if (!reader_.joinable() && !ended_ && !start_reader()) {
      const bool got = source_->next(segment);
      identity_ = source_->identity();
      share_ = source_->share_read();
      return got;
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ready_ > 0 || ended_; });
    if (ready_ > 0) {
      const auto place = static_cast<std::size_t>(taken_ % kSegmentsAhead);
      std::swap(segment, ring_[place].segment);
      std::swap(identity_, ring_[place].identity);
      share_ = ring_[place].share;
      ++taken_;
      --ready_;
      changed_.notify_all();
      return true;
    }
    lock.unlock();
    if (reader_.joinable()) reader_.join();
    identity_ = source_->identity();
    share_ = source_->share_read();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return false;
  }

  void rewind() override {
    stop();
    source_->rewind();
    identity_ = source_->identity();
    share_ = source_->share_read();
    taken_ = ready_ = 0;
    ended_ = stopping_ = false;
    failure_ = nullptr;
  }

  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return source_->issues(); }
  double share_read() const override { return share_; }

 private:
  /// A segment that was read and not handed out, and what was known of the log with it.
  struct Ahead {
    Log segment;
    LogIdentity identity;
    double share = 0.0;  ///< read
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
        if (got) {
          ahead.identity = source_->identity();
          ahead.share = source_->share_read();
        }
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
  LogIdentity identity_;  ///< with the segment handed out last; the reader is ahead of it
  double share_ = std::numeric_limits<double>::quiet_NaN();  ///< the same
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
