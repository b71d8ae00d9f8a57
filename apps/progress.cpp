// SPDX-License-Identifier: MIT
#include "apps/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lib/core/paint.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr int kProgressWidth = 30;
constexpr auto kRefresh = std::chrono::milliseconds(100);

std::string bar(double share, bool color) {
  const double known = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  const int full = static_cast<int>(known * kProgressWidth);
  char percent[8];
  std::snprintf(percent, sizeof percent, "%3d %%", static_cast<int>(known * 100));
  return "[" + painted(std::string(full, '='), Paint::green, color) +
         std::string(kProgressWidth - full, ' ') + "] " + percent;
}

}  // namespace

ProgressBar::ProgressBar(ColorChoice color, double delay_s)
    : on_terminal_(is_terminal(stderr)),
      color_(use_color(color, stderr)),
      next_(std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<int>(delay_s * 1000))) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

Progress ProgressBar::callback() {
  if (!on_terminal_) return {};
  return [this](const std::string& what, double share) { show(what, share); };
}

void ProgressBar::show(const std::string& what, double share) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kRefresh;
  shown_ = true;
  std::fprintf(stderr, "\r\x1b[K%s %s", bar(share, color_).c_str(), shortened(what, kLongestName).c_str());
}

}  // namespace faultline
