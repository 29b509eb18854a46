// The body that the machine moves, and the direction of its movement (algo/README.md, "Frames and
// signs").
//
// The fixture contains the probes and the metrology frame M; the probes measure the target. The
// machine moves either the fixture or the target. Its encoder may count in either direction.
#pragma once

namespace mdof {

struct Sides {
  bool fixture_moves = false;  // moves = "fixture"; false: the target moves
  // travel = "-": the body moves in the - direction of M when the position of the encoder
  // increases.
  bool against_encoder = false;

  bool operator==(const Sides&) const = default;

  // Travel of the moving body, positive in the + direction of M.
  double moving_body_travel_m(double encoder_m) const {
    return against_encoder ? -encoder_m : encoder_m;
  }
  // Travel d of the target in M; the models use this travel.
  double target_travel_m(double encoder_m) const {
    return fixture_moves ? -moving_body_travel_m(encoder_m) : moving_body_travel_m(encoder_m);
  }
  // Factor that converts an error of the target in M to an error of the moving body.
  double error_sign() const { return fixture_moves ? -1.0 : 1.0; }

  const char* moves() const { return fixture_moves ? "fixture" : "target"; }
  const char* travel() const { return against_encoder ? "-" : "+"; }
};

}  // namespace mdof
