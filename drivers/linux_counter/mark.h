// The reference mark of an encoder at a channel of a 104-QUAD-8 (or 104-QUAD-4). If `preset_enable`
// is 1, the kernel's driver loads the count from `preset` at the index
// (drivers/counter/104-quad-8.c).
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "drivers/counter/index_mark.h"
#include "schema/base/result.h"

namespace mdof::drivers {

inline constexpr const char* kQuad8 = "104-quad-8";  // contents of its file `name`
inline constexpr int kQuad8Bits = 24;

// Checks that the count (for example `folder`/count3) can load at its index, exactly at one count.
// Errors state which file needs which text.
Status check_quad8(const std::string& folder, const std::string& count, std::uint64_t ceiling);

// Arms the mark, watches it, and switches it off after it was passed: a later loss of counts must
// be visible and must not be corrected silently during a run. Thread-bound.
class Quad8Mark {
 public:
  using State = IndexMark::State;
  // `path`: folder of the count. `read`: returns the present count, unwrapped.
  Quad8Mark(std::string path, std::function<Result<std::int64_t>()> read)
      : path_(std::move(path)), read_(std::move(read)) {}

  Status arm();
  // Takes the next reading. Errors: neither motion nor the mark explains the count; a file cannot
  // be written.
  Result<State> take(std::int64_t count);
  std::int64_t from_mark(std::int64_t count) const { return mark_.from_mark(count); }

 private:
  Status enable(bool on) const;
  Status arm_at(std::int64_t count);
  std::string path_;
  std::function<Result<std::int64_t>()> read_;
  IndexMark mark_{kQuad8Bits};
  bool off_ = false;  // switched off since the mark was passed
};

}  // namespace mdof::drivers
