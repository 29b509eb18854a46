#include "tools/mdof/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::chrono::milliseconds kPatience{1000}, kInterval{100};
constexpr int kWidth = 30;

// A number with up to three digits and an SI prefix, such as "145 M", "2.5 k", "12 ".
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

ProgressBar::ProgressBar(std::string what, double done_before)
    : what_(std::move(what)),
      done_before_(done_before),
      wanted_(messages_are_on_terminal()),
      begin_(Clock::now()),
      next_(begin_ + kPatience) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::show_elapsed() {
  const auto now = Clock::now();
  if (!wanted_ || now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const auto elapsed_s = std::chrono::duration<double>(now - begin_).count();
  std::fprintf(stderr, "\r%s: %.0f s\x1b[K", what_.c_str(), elapsed_s);
  std::fflush(stderr);
}

void ProgressBar::show(const Progress& p) {
  if (!wanted_ || p.total <= 0 || p.done <= done_before_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
  const double share = p.done / p.total, rate = (p.done - done_before_) / elapsed_s;
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kWidth - full), '.');
  std::fprintf(stderr, "\r%s [%s] %3.0f %%  %s%s/s  %.0f s left\x1b[K", what_.c_str(), bar.c_str(),
               share * 100, with_prefix(rate).c_str(), p.unit, (p.total - p.done) / rate);
  std::fflush(stderr);
}

}  // namespace mdof::tools
