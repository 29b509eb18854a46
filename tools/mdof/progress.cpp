#include "tools/mdof/progress.h"

#include <algorithm>
#include <cstdio>

#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::milliseconds kPatience{1000}, kInterval{100};
constexpr int kWidth = 30;

// "145 M", "2.5 k", "12 ": three digits and an SI prefix.
std::string with_prefix(double x) {
  const char* prefix = "";
  for (const char* next : {"k", "M", "G"}) {
    if (x < 1000) break;
    x /= 1000;
    prefix = next;
  }
  char text[32];
  std::snprintf(text, sizeof text, x < 10 ? "%.2f %s" : x < 100 ? "%.1f %s" : "%.0f %s", x, prefix);
  return text;
}

}  // namespace

Progress::Progress(std::string what, std::string unit, double done)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      done_(done),
      wanted_(messages_are_on_terminal()),
      begin_(Clock::now()),
      next_(begin_ + kPatience) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double share, double total) {
  if (!wanted_ || share * total <= done_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kWidth - full), '.');
  const double rate = (share * total - done_) / elapsed_s;
  std::fprintf(stderr, "\r%s [%s] %3.0f %%  %s%s/s  %.0f s left\x1b[K", what_.c_str(), bar.c_str(),
               share * 100, with_prefix(rate).c_str(), unit_.c_str(), (1 - share) * total / rate);
  std::fflush(stderr);
}

}  // namespace mdof::tools
