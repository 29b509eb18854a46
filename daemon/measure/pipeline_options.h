// Options for the calculation of a run from samples. A replay needs only these options and the rig.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "algo/on_the_fly/target_grid.h"
#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "schema/encoder_datum.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Largest number of stops of a run. A point uses about 4 KB of memory.
inline constexpr std::size_t kMostStops = 50'000;

struct PipelineOptions {
  Model model = Model::rigid;
  algo::AlignOptions align;
  algo::DwellOptions dwell;
  algo::SequenceOptions sequence;
  double stale_s = 0.5;     // in the live view, an older frame is not shown as good
  bool keep_points = true;  // false: only for a live view without a run
  int repeats = 0;  // requested points for each target and approach; 0: the user ends the run
  bool remove_drift = false;  // remove a significant drift from the errors (algo/drift)
  // Only for replays; if set, dwells are not searched.
  std::optional<algo::OnTheFlyOptions> on_the_fly;
  EncoderDatum datum;                  // the pushed positions already include datum.offset_m
  std::size_t max_stops = kMostStops;  // later stops are counted but not evaluated

  std::string json() const;  // text for the provenance
  // The members of json() that the configuration states. The sampling intervals of the devices, the
  // targets, `repeats` and the datum are not included.
  std::string settings_json() const;
};

}  // namespace mdof::daemon
