// The reference mark of an encoder at a channel of a 104-QUAD-8 (or 104-QUAD-4): the kernel's
// driver of it loads the count from `preset` at the index where `preset_enable` is 1
// (drivers/counter/104-quad-8.c).
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "drivers/counter/index_mark.h"
#include "schema/base/result.h"

namespace mdof::drivers {

inline constexpr const char* kQuad8 = "104-quad-8";  // its file `name`
inline constexpr int kQuad8Bits = 24;

// Whether the count at `folder`/count3 can load at its index and does so within one count. Errors
// say what to write where.
Status check_quad8(const std::string& folder, const std::string& count, std::uint64_t ceiling);

// Arms it, watches it, and switches it off once the mark was passed: what the count loses later
// shows, and is not put right in silence in the midst of a run. Thread-bound.
class Quad8Mark {
 public:
  using State = IndexMark::State;
  // `path`: of the count's folder. `read`: the count now, unwrapped.
  Quad8Mark(std::string path, std::function<Result<std::int64_t>()> read)
      : path_(std::move(path)), read_(std::move(read)) {}

  Status arm();
  // The next reading. Error: it is astray, or a file cannot be written.
  Result<State> take(std::int64_t count);
  std::int64_t from_mark(std::int64_t count) const { return mark_.from_mark(count); }

 private:
  Status enable(bool on) const;
  Status arm_at(std::int64_t count);
  std::string path_;
  std::function<Result<std::int64_t>()> read_;
  IndexMark mark_{kQuad8Bits};
  bool off_ = false;  // since it was passed
};

}  // namespace mdof::drivers
