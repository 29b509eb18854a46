// The reference mark of an encoder at a channel of a 104-QUAD-8 (or 104-QUAD-4). If the file
// `preset_enable` contains 1, the kernel's driver (drivers/counter/104-quad-8.c) sets the count to
// the number in the file `preset` when the index signal occurs.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "drivers/counter/index_mark.h"
#include "schema/base/result.h"

namespace mdof::drivers {

inline constexpr const char* kQuad8 = "104-quad-8";  // contents of the device's file `name`
inline constexpr int kQuad8Bits = 24;

// Checks that the index signal can set the count in `folder`/`count` (for example count3), and that
// the signal is active at only one count of the encoder. Errors state which text must be in which
// file.
Status check_quad8(const std::string& folder, const std::string& count, std::uint64_t ceiling);

// Waits for the mark. After the mark was passed, the object sets preset_enable to 0: a later loss
// of counts must be visible and must not be corrected silently during a run. Thread-bound.
class Quad8Mark {
 public:
  using State = IndexMark::State;
  // `path`: folder of the count. `read`: returns the present count, extended over overflows.
  Quad8Mark(std::string path, std::function<Result<std::int64_t>()> read)
      : path_(std::move(path)), read_(std::move(read)) {}

  Status arm();
  // Evaluates the next reading. Errors: neither a motion nor the mark explains the count; a file
  // cannot be written.
  Result<State> take(std::int64_t count);
  std::int64_t from_mark(std::int64_t count) const { return mark_.from_mark(count); }

 private:
  Status enable(bool on) const;
  Status arm_at(std::int64_t count);
  std::string path_;
  std::function<Result<std::int64_t>()> read_;
  IndexMark mark_{kQuad8Bits};
  bool off_ = false;  // preset_enable was set to 0 after the mark was passed
};

}  // namespace mdof::drivers
