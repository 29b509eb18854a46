#include "tools/mdof/progress.h"

#include <algorithm>
#include <cstdio>

#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::milliseconds kPatience{1000}, kInterval{100};
constexpr int kWidth = 30;

}  // namespace

Progress::Progress(std::string what, std::uint64_t total_bytes)
    : what_(std::move(what)),
      total_mb_(static_cast<double>(total_bytes) * 1e-6),
      wanted_(messages_are_on_terminal()),
      begin_(Clock::now()),
      next_(begin_ + kPatience) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double share) {
  if (!wanted_ || total_mb_ <= 0 || share <= 0) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kWidth - full), '.');
  std::fprintf(stderr, "\r%s [%s] %3.0f %%  %.0f MB/s  %.0f s left\x1b[K", what_.c_str(),
               bar.c_str(), share * 100, share * total_mb_ / elapsed_s,
               elapsed_s * (1 - share) / share);
  std::fflush(stderr);
}

}  // namespace mdof::tools
