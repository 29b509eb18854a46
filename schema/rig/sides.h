// Which body moves, and which way (algo/README.md, "Frames and signs").
//
// The fixture holds the probes and carries the metrology frame M; the target is what they look at.
// A machine moves one of the two against the other, and its encoder may count either way.
#pragma once

namespace mdof {

struct Sides {
  bool fixture_moves = false;  // moves = "fixture"; else the target moves
  bool against_encoder =
      false;  // travel = "-": the moving body goes along - of M as the encoder grows

  bool operator==(const Sides&) const = default;

  // Travel of the body that moves, along + of M.
  double own_travel_m(double encoder_m) const { return against_encoder ? -encoder_m : encoder_m; }
  // Travel d of the target in M, as the models have it.
  double target_travel_m(double encoder_m) const {
    return fixture_moves ? -own_travel_m(encoder_m) : own_travel_m(encoder_m);
  }
  // An error of the moving body is that of the target in M times this.
  double error_sign() const { return fixture_moves ? -1.0 : 1.0; }

  const char* moves() const { return fixture_moves ? "fixture" : "target"; }
  const char* travel() const { return against_encoder ? "-" : "+"; }
};

}  // namespace mdof
