#pragma once

namespace mdof::daemon {

// The build sets it from the project's version. The provenance of every result contains it.
extern const char* const kVersion;

}  // namespace mdof::daemon
