// The two simulations of Kweon, Liu, Yang, "A multi-degree of freedom measurement system for
// determining geometric errors in miniaturized machine tool"; every parameter is an option. A trial
// draws a travel and five errors, and calculates the exact outputs of the probes (Eq. 3-7). In
// simulation II the probes are displaced and the units are installed with errors (Eq. 13-20). The
// outputs of the probes are solved by the simplified solution (Eq. 8-12) of the nominal fixture.
// Each result is estimate - truth.
//
// Simulation II moves each probe and then calculates the exact output at the new place:
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

// The default values are those of simulation I in the appendix of the paper.
struct SimulationOptions {
  double angle_range_urad = 1000;  // εx, εy, εz are uniform within ± angle_range_urad
  double offset_range_um = 50;     // δy, δz are uniform within ± offset_range_um
  double travel_from_mm = 0, travel_to_mm = 60;
  std::size_t travel_bins = 20;
  double l_mm = 10;  // l: x of probes A and E, ±y of probes B and C
  // h: y of the side surface of the target (0 in the equations of the paper).
  double side_plane_mm = 0;
  double side_height_mm = 20;                             // l'': z of probes D and E
  double radius_um = 0;                                   // r: mounting tolerance of the probes
  double theta_y_mrad = 0;                                // rotation of the top unit about Z
  double theta_p_mrad = 0;                                // rotation of the side unit about Y
  double theta_r_mrad = 0;                                // rotation of both units about X
  double sigma_x_um = 0, sigma_y_um = 0, sigma_z_um = 0;  // offsets of the units
  std::uint64_t seed = 1;
};

SimulationOptions simulation_1_defaults();
SimulationOptions simulation_2_defaults();  // r = 10 µm, θ = 2 mrad, σ = 50 µm, travel to 10 mm

// Numbers of the draws: 0 travel (within the bin), 1 δy, 2 δz, 3 εx, 4 εy, 5 εz, 6-10 angles α of
// probes A to E. Outputs: EYX_um EZX_um EAX_urad EBX_urad ECX_urad. The binned quantity is
// travel_mm. Error: an invalid option; the message contains its name.
Result<std::unique_ptr<Experiment>> make_simulation(const SimulationOptions& options,
                                                    InstructionSet set = best_instruction_set());

// Drawn numbers and results of one trial.
struct SimulationTrial {
  double travel_mm = 0;
  double truth[5] = {};        // δy, δz in µm; εx, εy, εz in µrad
  double probe_turns[5] = {};  // α of A to E
  double error[5] = {};        // outputs in the order and units of run()
};
Result<SimulationTrial> simulation_trial(const SimulationOptions& options, std::uint64_t trial);

}  // namespace mdof::algo
