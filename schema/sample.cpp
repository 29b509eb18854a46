#include "schema/sample.h"

namespace mdof {
namespace {

template <class T>
void append_range(std::vector<T>& to, const std::vector<T>& from, std::size_t begin,
                  std::size_t end) {
  using Offset = typename std::vector<T>::difference_type;
  to.insert(to.end(), from.begin() + static_cast<Offset>(begin),
            from.begin() + static_cast<Offset>(end));
}

void append_quality(SampleBlock& to, const SampleBlock& from, std::size_t begin, std::size_t end) {
  if (to.quality.empty() && from.quality.empty()) return;
  to.quality.resize(to.channels.size());
  for (std::size_t c = 0; c < to.channels.size(); ++c) {
    to.quality[c].resize(to.scans(), Quality::good);
    if (from.quality.empty() || from.quality[c].empty())
      to.quality[c].insert(to.quality[c].end(), end - begin, Quality::good);
    else
      append_range(to.quality[c], from.quality[c], begin, end);
  }
}

}  // namespace

void append_scans(SampleBlock& to, const SampleBlock& from, std::size_t begin, std::size_t end) {
  append_quality(to, from, begin, end);
  append_range(to.time_ns, from.time_ns, begin, end);
  for (std::size_t c = 0; c < to.channels.size(); ++c)
    append_range(to.value[c], from.value[c], begin, end);
}

}  // namespace mdof
