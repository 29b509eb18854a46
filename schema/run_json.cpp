#include "schema/run_json.h"

#include <algorithm>
#include <cmath>

#include "schema/imported/series.h"
#include "schema/iso230/figures_json.h"
#include "schema/plausibility/plausibility_json.h"
#include "schema/recording/run_options.h"
#include "schema/rig/correction.h"
#include "schema/uncertainty/budget_json.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr const char* kTableSense =
    "error = actual minus nominal position of the moving body; correction = factor times the "
    "error. The correction is added to the commanded position of an axis. In the "
    "member \"correction\", \"factor\" is the factor and \"command\" is the axis";

constexpr const char* kPositioningTableSense =
    "error = actual minus commanded position of the axis in coordinates of the controller; "
    "correction = factor times the error. The correction is added to the commanded position of an "
    "axis. In the member \"correction\", \"factor\" is the factor and \"command\" is the axis";

// Writes {"EYX_um": {"factor", "command", "reason"}, ...}. The correction is the factor times the
// error; it is added to the command of the axis "command". If the factor is null, there is no
// correction, and "reason" states why.
void write_corrections(JsonWriter& json, const CompensationTable& t) {
  const CorrectionSigns signs = correction_signs(t.machine, t.axis, t.sides, t.stated.reference);
  json.key("correction").begin_object();
  for (std::size_t k = 0; k < 5; ++k) {
    const ErrorName& name = error_names(t.axis)[k];
    json.key(name.key).begin_object().key("factor");
    signs.factor[k] == 0 ? json.null() : json.value(signs.factor[k]);
    json.field("command", std::string(1, corrected_by(name)));
    if (!signs.gap[k].empty()) json.field("reason", signs.gap[k]);
    json.end_object();
  }
  if (t.has_positioning()) {
    json.key(positioning_name(t.axis) + "_um").begin_object().field("factor", -1);
    json.field("command", std::string(1, letter(t.axis))).end_object();
  }
  json.end_object();
}

// Values of the table for one approach.
struct Side {
  bool is_forward;
  const std::array<std::vector<double>, 5>&values, &u;
  const std::vector<double>&along, &u_along;
};

void write_side(JsonWriter& json, const CompensationTable& t, const Side& side, std::size_t row) {
  const auto write_five = [&](auto value) {
    for (std::size_t k = 0; k < kErrorCount; ++k)
      json.field(error_names(t.axis)[k].key, to_key_unit(value(k)));
  };
  const auto write_along = [&](double value) {
    if (t.has_positioning()) json.field(positioning_name(t.axis) + "_um", to_key_unit(value));
  };
  const auto along = [&](const std::vector<double>& series) {
    return t.has_positioning() ? series[row] : std::nan("");
  };
  json.begin_object();
  write_five([&](std::size_t k) { return side.values[k][row]; });
  write_along(along(side.along));
  json.key("u").begin_object();
  write_five([&](std::size_t k) { return t.u_of(side.u, k, row); });
  write_along(t.has_positioning() ? t.positioning_u_at(side.is_forward, row) : std::nan(""));
  json.end_object();
  if (t.has_declared()) {
    json.key("u_random").begin_object();
    write_five([&](std::size_t k) { return side.u[k][row]; });
    write_along(along(side.u_along));
    json.end_object();
  }
  json.end_object();
}

// Converts -0, which results from subtractions, to 0.
double plain(double x) {
  return x + 0.0;
}

// True if the point has more than five readings. Five readings have no residual.
bool redundant(const MeasuredPoint& p) {
  return std::count_if(p.point.probe_m.begin(), p.point.probe_m.end(),
                       [](double m) { return std::isfinite(m); }) > kErrorCount;
}

}  // namespace

bool are_scans_known(const RunHeader& h) {
  return h.scans > 0 || std::none_of(h.notices.begin(), h.notices.end(), [](const Notice& each) {
           return each.code == NoticeCode::interrupted;
         });
}

bool is_lost_known(const RunHeader& h) {
  return are_scans_known(h) &&
         ((h.provenance.recording_kind != "csv" && !is_imported(h)) || h.scans_lost > 0);
}

void write_strings(JsonWriter& json, const char* key, const std::vector<std::string>& texts) {
  json.key(key).begin_array();
  for (const auto& text : texts) json.value(text);
  json.end_array();
}

void write_reference(JsonWriter& json, const StatedAt& at) {
  json.field("reference", to_string(at.reference)).key("reference_mm");
  if (at.reference == Reference::carriage) {
    json.null();
    return;
  }
  json.begin_array();
  for (const double x : at.point_m) json.value(to_mm(x));
  json.end_array();
}

void write_reference(JsonWriter& json, const CompensationTable& table) {
  if (!table.has_positioning()) return write_reference(json, table.stated);
  json.key("reference").null().key("reference_mm").null();
}

void write_point(JsonWriter& json, const MovingAxis& moving, const MeasuredPoint& p,
                 const ErrorsUncertainty& uncertainty) {
  const Axis axis = moving.axis;
  json.begin_object()
      .field("target", p.target)
      .field("target_mm", plain(to_mm(p.target_m)))
      .field("run", p.run)
      .field("direction", p.point.direction)
      .field("position_mm", plain(to_mm(p.point.position_m)));
  const Errors5 named = named_from_local(moving, p.errors.local);
  for (std::size_t k = 0; k < 5; ++k) {
    json.key(error_names(axis)[k].key);
    p.errors.valid ? json.value(plain(to_key_unit(named[k]))) : json.null();
  }
  write_uncertainty(json, axis, uncertainty);
  const bool judged = p.errors.valid && redundant(p);
  json.field("residual_um", judged ? to_um(p.errors.residual_m) : std::nan(""))
      .field("samples", p.point.samples);
  write_strings(json, "flags", flag_texts(p.point.flags));
  if (!p.errors.valid) json.field("reason", p.errors.reason);
  json.end_object();
}

namespace {

void write_temperature(JsonWriter& json, const std::optional<Temperature>& read) {
  json.key("temperature_C");
  if (!read) {
    json.null();
    return;
  }
  json.begin_object()
      .field("mean", read->mean_C)
      .field("min", read->min_C)
      .field("max", read->max_C)
      .end_object();
}

}  // namespace

namespace {

// For an imported run, "moves" is unknown, and "travel" is known only if the import states it.
void write_sides(JsonWriter& json, const RunHeader& h) {
  json.key("moves");
  is_imported(h) ? json.null() : json.value(h.sides.moves());
  json.key("travel");
  if (!is_imported(h)) {
    json.value(h.sides.travel());
    return;
  }
  const auto against_command = run_options(h).imported.against_command;
  against_command ? json.value(*against_command ? "-" : "+") : json.null();
}

}  // namespace

void write_header_members(JsonWriter& json, const RunHeader& h, NoticeWords words) {
  const std::string axis(1, letter(h.axis));
  json.key("run");
  h.id == 0 ? json.null() : json.value(h.id);
  json.field("axis", axis).field("model", h.provenance.model);
  if (is_imported(h))
    json.key("reference").null().key("reference_mm").null();
  else
    write_reference(json, h.stated);
  write_sides(json, h);
  json.field("state", to_string(h.state))
      .field("simulated", h.simulated)
      .field("started_utc", h.started_utc)
      .field("start_known", h.start_known)
      .field("note", h.note);
  json.key("supersedes");
  h.supersedes ? json.value(*h.supersedes) : json.null();
  json.key("scans");
  are_scans_known(h) ? json.value(h.scans) : json.null();
  json.key("scans_lost");
  is_lost_known(h) ? json.value(h.scans_lost) : json.null();
  write_temperature(json, h.temperature);
  json.key("recording")
      .begin_object()
      .field("kind", h.provenance.recording_kind)
      .field("path", h.provenance.recording_path)
      .field("sha256", h.provenance.recording_sha256)
      .end_object();
  json.field("software_version", h.provenance.software_version);
  json.key("options");
  h.provenance.options_json.empty() ? json.null() : json.raw(h.provenance.options_json);
  write_notices(json, "notices", h.notices, words);
}

const Budget* slope_budget(const std::vector<Budget>& budgets, const StraightnessFigure& figure) {
  if (figure.approach != "mean") return nullptr;
  return find_budget(budgets, figure.error_key.substr(0, 3) + "_slope_urad");
}

void write_straightness(JsonWriter& json, const std::vector<StraightnessFigure>& figures,
                        const std::vector<Budget>& budgets) {
  write_by_key(json, figures, [&](const StraightnessFigure& f) {
    const Budget* budget = slope_budget(budgets, f);
    json.field("least_squares_um", to_um(f.straightness_least_squares_m))
        .field("end_point_um", to_um(f.straightness_end_point_m))
        .field("slope_least_squares_urad", plain(to_urad(f.slope_least_squares_rad)))
        .field("u_slope_least_squares_urad", budget ? to_urad(budget->u) : std::nan(""))
        .field("form_urad", plain(to_urad(f.form_rad)))
        .field("slope_end_point_urad", plain(to_urad(f.slope_end_point_rad)))
        .field("peak_mm", plain(to_mm(f.peak_position_m)))
        .field("valley_mm", plain(to_mm(f.valley_position_m)));
  });
}

void write_angles(JsonWriter& json, const std::vector<AngleFigure>& figures) {
  write_by_key(json, figures, [&](const AngleFigure& f) {
    json.field("start_urad", plain(to_urad(f.start_rad)))
        .field("min_urad", plain(to_urad(f.min_rad)))
        .field("max_urad", plain(to_urad(f.max_rad)))
        .field("range_urad", to_urad(f.max_rad - f.min_rad));
  });
}

void write_run_members(JsonWriter& json, const RunMembers& members, NoticeWords words) {
  const auto& [run, header, uncertainty, figures, with_points, visit_limit] = members;
  write_header_members(json, header, words);
  write_covers(json, uncertainty);
  json.field("points_total", static_cast<std::uint64_t>(run.points.size()));
  if (with_points) {
    json.key("points").begin_array();
    for (std::size_t j = 0; j < run.points.size(); ++j)
      write_point(json, run.header.moving(), run.points[j], uncertainty.points[j]);
    json.end_array();
  }
  json.key("straightness");
  write_straightness(json, run.straightness, figures.budgets);
  json.key("angles");
  write_angles(json, run.angles);
  write_stated(json, figures);
  json.key("plausibility");
  run.plausibility ? write_plausibility(json, *run.plausibility, visit_limit)
                   : static_cast<void>(json.null());
}

namespace {

std::string run_key(Axis axis) {
  return std::string("run_") + static_cast<char>(letter(axis) - 'A' + 'a');
}

std::string corner_text(const Squareness& s) {
  const std::string a(1, letter(s.axes.a)), b(1, letter(s.axes.b));
  return s.artefact.corner > 0 ? "+" + a + " +" + b + " or -" + a + " -" + b
                               : "-" + a + " +" + b + " or +" + a + " -" + b;
}

}  // namespace

void write_squareness_members(JsonWriter& json, const Squareness& s,
                              const std::vector<Budget>& budgets) {
  const Budget& budget = budgets.front();
  const std::string name = std::string(squareness_name(s.axes)) + "_urad";
  const std::string slope_a = std::string("slope_") + s.straightness_a() + "_urad";
  const std::string slope_b = std::string("slope_") + s.straightness_b() + "_urad";
  json.field("squareness", s.id)
      .field(run_key(s.axes.a), s.run_a)
      .field(run_key(s.axes.b), s.run_b)
      .field(name, to_urad(s.error_rad))
      .field("u_" + name, to_urad(budget.u))
      .field("u_random_" + name, to_urad(budget.u_random))
      .field("U_" + name, to_urad(budget.U))
      .field("k", budget.coverage_factor)
      .field("nu_eff", budget.freedom);
  write_covers(json, {budget});
  json.field("noise_only", budget.noise_only)
      .field("form_urad", to_urad(s.form_rad))
      .field("reference", to_string(Reference::fixture))
      .field(slope_a, to_urad(s.slope_a_rad))
      .field("u_" + slope_a, to_urad(s.u_slope_a_rad))
      .field(slope_b, to_urad(s.slope_b_rad))
      .field("u_" + slope_b, to_urad(s.u_slope_b_rad))
      .field("square_tilt_urad", to_urad(s.tilt_rad()))
      .field("artefact_angle_error_urad", to_urad(s.artefact.angle_error_rad))
      .field("u_artefact_angle_urad", to_urad(s.artefact.u_rad.value_or(std::nan(""))));
  json.key("artefact_corner");
  s.artefact.corner == 0 ? json.null() : json.value(corner_text(s));
  write_stated(json, {budgets, ""});
  json.field("slopes_over", "travel of the moving body in the + direction of the axis")
      .field("sense", squareness_sense(s.axes, " deg"))
      .field("simulated", s.simulated)
      .field("created_utc", s.created_utc);
}

std::string with_notices(std::string json, const Notices& notices, NoticeWords words) {
  JsonWriter list;
  write_notices(list.begin_object(), "notices", notices, words);
  json.pop_back();
  return json + "," + list.text().substr(1) + "}";
}

void write_table_row(JsonWriter& json, const CompensationTable& t, std::size_t row) {
  json.begin_object().field("position_mm", to_mm(t.position_m[row]));
  json.key("forward");
  write_side(json, t,
             {true, t.forward, t.u_forward, t.positioning.forward, t.positioning.u_forward}, row);
  json.key("reverse");
  write_side(json, t,
             {false, t.reverse, t.u_reverse, t.positioning.reverse, t.positioning.u_reverse}, row);
  json.end_object();
}

void write_table_members(JsonWriter& json, const CompensationTable& t) {
  const std::string axis(1, letter(t.axis));
  json.field("table", t.id).field("axis", axis).field("simulated", t.simulated);
  json.key("runs").begin_array();
  for (const auto id : t.runs) json.value(id);
  json.end_array().key("added_to");
  t.added_to ? json.value(*t.added_to) : json.null();
  write_reference(json, t);
  if (t.has_positioning()) {  // positioning does not depend on which body moves
    json.key("moves").null().key("travel").null();
    json.field("positioning_sense", to_string(kTablePositioningSense));
  } else {
    json.field("moves", t.sides.moves()).field("travel", t.sides.travel());
  }
  json.key("chain");
  t.machine.known() ? json.value(t.machine.text) : json.null();
  json.field("chain_travel", chain_travels_text(t.machine));
  write_corrections(json, t);
  json.field("sense", t.has_positioning() ? kPositioningTableSense : kTableSense);
  if (t.has_positioning())
    json.key("straightness_reference").null().key("angle_reference").null();
  else
    json.field("straightness_reference", t.slope_removed ? "least squares line" : "as measured")
        .field("angle_reference", "first target, mean of both approaches");
  json.field("first_mm", to_mm(t.position_m.front()))
      .field("last_mm", to_mm(t.position_m.back()))
      .field("points_total", static_cast<std::uint64_t>(t.position_m.size()))
      .field("created_utc", t.created_utc)
      .field("sha256", t.sha256);
  write_covers(json, covers_text(t), t.not_declared);
}

std::string table_json(const CompensationTable& t) {
  JsonWriter json;
  json.begin_object();
  write_table_members(json, t);
  json.key("points").begin_array();
  for (std::size_t i = 0; i < t.position_m.size(); ++i) write_table_row(json, t, i);
  json.end_array().end_object();
  return json.take();
}

}  // namespace mdof
