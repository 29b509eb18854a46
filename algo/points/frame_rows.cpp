#include "algo/points/frame_rows.h"

namespace mdof::algo {
namespace {

// Appends the marks of the rows `first` to `last` - 1 to a column of `before` marks. An empty
// column stands for `none` in each row.
template <class Column>
void append_marks(Column& to, const Column* from, std::size_t before, std::size_t first,
                  std::size_t last, typename Column::value_type none) {
  if (from && !from->empty()) {
    to.resize(before, none);
    to.insert(to.end(), from->begin() + static_cast<std::ptrdiff_t>(first),
              from->begin() + static_cast<std::ptrdiff_t>(last));
  } else if (!to.empty()) {
    to.resize(before + last - first, none);
  }
}

}  // namespace

FrameBlock empty_frames(std::size_t probes) {
  FrameBlock frames;
  frames.probe_m.resize(probes);
  frames.probe_quality.resize(probes);
  frames.probe_is_new.resize(probes);
  return frames;
}

void append_rows(FrameBlock& to, const FrameBlock& from, std::size_t first, std::size_t last) {
  const auto range = [&](const auto& column, auto& target) {
    target.insert(target.end(), column.begin() + static_cast<std::ptrdiff_t>(first),
                  column.begin() + static_cast<std::ptrdiff_t>(last));
  };
  const std::size_t before = to.size();
  range(from.time_ns, to.time_ns);
  range(from.encoder_m, to.encoder_m);
  for (std::size_t k = 0; k < from.probe_m.size(); ++k) {
    range(from.probe_m[k], to.probe_m[k]);
    append_marks(to.probe_quality[k],
                 k < from.probe_quality.size() ? &from.probe_quality[k] : nullptr, before, first,
                 last, Quality::good);
    append_marks(to.probe_is_new[k], k < from.probe_is_new.size() ? &from.probe_is_new[k] : nullptr,
                 before, first, last, std::uint8_t{1});
  }
}

void erase_rows(FrameBlock& frames, std::size_t first, std::size_t last) {
  const auto erase = [&](auto& column) {
    if (column.empty()) return;
    column.erase(column.begin() + static_cast<std::ptrdiff_t>(first),
                 column.begin() + static_cast<std::ptrdiff_t>(last));
  };
  erase(frames.time_ns);
  erase(frames.encoder_m);
  for (auto& column : frames.probe_m) erase(column);
  for (auto& column : frames.probe_quality) erase(column);
  for (auto& column : frames.probe_is_new) erase(column);
}

}  // namespace mdof::algo
