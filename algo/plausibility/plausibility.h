// Can this run be right? What was found, in figures, and what in them looks wrong, in words: holes
// in the matrix of visits, stops that gave no point, quantities in other units than stated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "schema/plausibility.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

struct RunToJudge {
  const Rig& rig;
  const Sequence& sequence;  // its points solved
  const DwellDetector::Summary& dwells;
  std::uint64_t scans_lost = 0;
  bool targets_given = false;
  double least_dwell_s = 0;  // that a stop must last to be averaged
};

Plausibility plausibility(const RunToJudge& run);

// Each one sentence, by name; none: nothing looks wrong. Many of a kind are summarised.
std::vector<std::string> warnings_of_visits(const RunToJudge& run, const Plausibility& figures);
std::vector<std::string> warnings_of_units(const Rig& rig, const Plausibility& figures);
// A probe that reads the same while others change, an encoder that stands still while probes
// change.
std::vector<std::string> warnings_of_signals(const RunToJudge& run);

// What a travel (m) says of the encoder's unit; empty: nothing.
std::string encoder_unit_doubt(double travel_m);

// Stops at a target that gave no point, and beside which there is none of that target either.
std::vector<DwellDetector::Summary::PassedOver> lost_stops(const RunToJudge& run);

}  // namespace mdof::algo
