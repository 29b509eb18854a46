#pragma once

namespace mdof::daemon {

// Set by the build from the project's version; goes into every result's provenance.
extern const char* const kVersion;

}  // namespace mdof::daemon
