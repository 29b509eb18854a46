// mdof compensation build --machine: builds and stores corrections over a plane or a volume.
#pragma once

#include <optional>
#include <string>

#include "schema/base/result.h"
#include "tools/mdof/options.h"

namespace mdof::tools {

struct VolumeOptions {
  std::string machine, plane, at, approach;
  bool volume = false, incomplete = false;
  std::optional<double> step_mm;

  bool asked() const { return !machine.empty(); }
  // Error (usage): the user stated one of these options without --machine.
  Status check_unused() const;
};
void add_volume_options(CLI::App& command, VolumeOptions& options);

struct VolumeBuild {
  VolumeOptions options;
  LimitOptions limits;
  std::string database, socket;
  bool json = false, all_warnings = false;
};
Status build_volume(const VolumeBuild& command);

}  // namespace mdof::tools
