#include "schema/iso230/iso230_json.h"

#include <string>

#include "schema/axis.h"
#include "schema/iso230/figures_json.h"
#include "schema/uncertainty/run_uncertainty.h"
#include "schema/units.h"

namespace mdof {
namespace {

// Returns 0 for -0, because -0 can result from a subtraction and confuses readers and scripts.
double unsigned_zero(double x) {
  return x + 0.0;
}

void write_line(JsonWriter& json, const char* name, const ReferenceLine& line) {
  json.key(name)
      .begin_object()
      .field("slope_um_per_m", unsigned_zero(to_urad(line.slope_rad)))
      .field("intercept_um", unsigned_zero(to_um(line.intercept_m)))
      .field("zone_um", to_um(line.zone_m))
      .field("residual_um", to_um(line.residual_m))
      .end_object();
}

void write_squareness_line(JsonWriter& json, const char* name, const Squareness& of,
                           const SquarenessLine& line) {
  json.key(name)
      .begin_object()
      .field(std::string(squareness_name(of.axes)) + "_urad",
             unsigned_zero(to_urad(line.error_rad)))
      .field(std::string("slope_") + of.straightness_a() + "_urad",
             unsigned_zero(to_urad(line.slope_a_rad)))
      .field(std::string("slope_") + of.straightness_b() + "_urad",
             unsigned_zero(to_urad(line.slope_b_rad)))
      .end_object();
}

// Writes several members whose names end with the same unit.
class Figures {
 public:
  Figures(JsonWriter& json, bool angle) : json_(json), unit_(angle ? "_urad" : "_um") {}
  const Figures& operator()(const std::string& name, double value) const {
    json_.field(name + unit_, unsigned_zero(to_key_unit(value)));
    return *this;
  }

 private:
  JsonWriter& json_;
  std::string unit_;
};

void write_target(JsonWriter& json, const Figures& figures, const PositioningTarget& t) {
  json.begin_object()
      .field("target_mm", unsigned_zero(to_mm(t.target_m)))
      .field("n_forward", static_cast<std::uint64_t>(t.forward.n))
      .field("n_reverse", static_cast<std::uint64_t>(t.reverse.n));
  figures("mean_forward", t.forward.mean)("mean_reverse", t.reverse.mean)("mean", t.mean);
  figures("s_forward", t.forward.s)("s_reverse", t.reverse.s);
  figures("B", t.B)("R_forward", t.forward.R)("R_reverse", t.reverse.R)("R", t.R);
  json.end_object();
}

}  // namespace

void write_reference_lines(JsonWriter& json, const ReferenceLines& lines) {
  write_line(json, "end_point", lines.end_point);
  write_line(json, "least_squares", lines.least_squares);
  write_line(json, "minimum_zone", lines.minimum_zone);
}

void write_straightness_lines(JsonWriter& json, const std::vector<StraightnessLines>& lines) {
  write_by_key(json, lines,
               [&](const StraightnessLines& of) { write_reference_lines(json, of.lines); });
}

void write_squareness_lines(JsonWriter& json, const Squareness& of, const SquarenessByLine& lines) {
  json.begin_object();
  write_squareness_line(json, "end_point", of, lines.end_point);
  write_squareness_line(json, "least_squares", of, lines.least_squares);
  write_squareness_line(json, "minimum_zone", of, lines.minimum_zone);
  json.end_object();
}

void write_parallelism(JsonWriter& json, const Parallelism& parallelism) {
  const auto write_line = [&](const char* reference, const ParallelismLine& line) {
    json.key(reference)
        .begin_object()
        .field("angle_urad", to_urad(line.angle_rad))
        .field("slope_a_urad", to_urad(line.slope_a_rad))
        .field("slope_b_urad", to_urad(line.slope_b_rad))
        .end_object();
  };
  json.key("parallelism").begin_object();
  for (const ParallelismOfPlane& plane : parallelism.planes) {
    json.key(plane.error).begin_object();
    write_line("end_point", plane.end_point);
    write_line("least_squares", plane.least_squares);
    write_line("minimum_zone", plane.minimum_zone);
    json.end_object();
  }
  json.end_object();
}

void write_positioning(JsonWriter& json, const Positioning& p, bool angle) {
  const Figures figures(json, angle);
  for (const PositioningParameter& of : kPositioningParameters) figures(of.name, p.*of.value);
  json.key("targets").begin_array();
  for (const PositioningTarget& t : p.targets) write_target(json, figures, t);
  json.end_array();
}

void write_run_positioning_uncertainty(JsonWriter& json, const RunPositioningUncertainty& U,
                                       bool angle) {
  json.begin_object().field("coverage", 0.95);
  const Figures figures(json, angle);
  for (const PositioningParameter& of : kPositioningParameters)
    figures(std::string("U_") + of.name, U.*of.U);
  json.field("U_A_reason", U.kWhyNotOfA);
  write_covers(json, U.covers, U.not_declared);
  json.field("R_is_of", "the approaches of this run").end_object();
}

void write_positioning_uncertainty(JsonWriter& json, const PositioningUncertainty& U) {
  json.begin_object()
      .field("k", 2)
      .field("U_device_um", to_um(U.device))
      .field("U_drift_um", to_um(U.drift))
      .field("U_E_M_A_um", to_um(U.E_M_A))
      .field("U_B_um", to_um(U.B))
      .field("not_covered", "temperature of the machine, alignment")
      .end_object();
}

}  // namespace mdof
