// Options for finding a run in samples: everything that a replay accepts besides its rig.
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

// Limit of the stops of a run. A point takes about 4 KB of memory.
inline constexpr std::size_t kMostStops = 50'000;

struct PipelineOptions {
  Model model = Model::rigid;
  algo::AlignOptions align;
  algo::DwellOptions dwell;
  algo::SequenceOptions sequence;
  double stale_s = 0.5;       // an older instant is not shown as good
  bool keep_points = true;    // false: for a view without a run
  int repeats = 0;            // requested repeats from both sides; 0: until stopped
  bool remove_drift = false;  // remove significant drift from the errors (algo/drift)
  std::optional<algo::OnTheFlyOptions> on_the_fly;  // for replays; dwells are then not searched
  EncoderDatum datum;                  // datum that the pushed positions already contain
  std::size_t max_stops = kMostStops;  // further stops are counted and left out

  std::string json() const;  // for the provenance
  // The part of json() that the configuration gives: without the devices' rates, targets and datum.
  std::string settings_json() const;
};

}  // namespace mdof::daemon
