// The two simulations of Kweon, Liu, Yang, "A multi-degree of freedom measurement system for
// determining geometric errors in miniaturized machine tool"; every parameter is an option. A trial
// draws a travel and five errors, calculates the exact outputs of the probes (Eq. 3-7; in II Eq.
// 13-20: displaced probes, units installed with errors) and solves them by the simplified solution
// (Eq. 8-12) of the nominal fixture. Each output is estimate - truth.
//
// Simulation II moves each probe and then uses the exact output at its new place:
//   p' = p + r (cos 2πα, sin 2πα), α uniform, in x-y for A B C and in x-z for D E (Eq. 13-15);
//   top unit  x' = x' - θy y' + σx, y' = y' + θy x' + σy;
//   side unit x' = x' + θp z' + σx, z' = z' - θp x' + σz  (README.md has the derivation).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "algo/sensitivity/experiment.h"
#include "schema/base/instruction_set.h"
#include "schema/base/result.h"

namespace mdof::algo {

// Defaults: the paper's appendix, simulation I.
struct SimulationOptions {
  double angle_range_urad = 1000;  // εx, εy, εz are uniform within ± this
  double offset_range_um = 50;     // δy, δz are uniform within ± this
  double travel_from_mm = 0, travel_to_mm = 60;
  std::size_t travel_bins = 20;
  double l_mm = 10;            // l: x of A and E, ±y of B and C
  double side_plane_mm = 0;    // h: y of the side target surface (the paper's equations have 0)
  double side_height_mm = 20;  // l'': z of D and E
  double radius_um = 0;        // r: probe-mounting tolerance
  double theta_y_mrad = 0;     // rotation of the top unit about Z
  double theta_p_mrad = 0;     // rotation of the side unit about Y
  double theta_r_mrad = 0;     // rotation of both units about X
  double sigma_x_um = 0, sigma_y_um = 0, sigma_z_um = 0;  // offsets of the units
  std::uint64_t seed = 1;
};

SimulationOptions simulation_1_defaults();
SimulationOptions simulation_2_defaults();  // r = 10 µm, θ = 2 mrad, σ = 50 µm, travel to 10 mm

// Draws of trial i: 0 travel (within its bin), 1 δy, 2 δz, 3 εx, 4 εy, 5 εz, 6-10 angles of A to E.
// Outputs: EYX_um EZX_um EAX_urad EBX_urad ECX_urad; bins of travel_mm. Error: an invalid option,
// with its name.
Result<std::unique_ptr<Experiment>> make_simulation(const SimulationOptions& options,
                                                    InstructionSet set = best_instruction_set());

// Details of one trial, to replay it alone.
struct SimulationTrial {
  double travel_mm = 0;
  double truth[5] = {};        // δy, δz in µm; εx, εy, εz in µrad
  double probe_turns[5] = {};  // α of A to E
  double error[5] = {};        // outputs of run(), in their order and units
};
Result<SimulationTrial> simulation_trial(const SimulationOptions& options, std::uint64_t trial);

}  // namespace mdof::algo
